#include "framework/study/study_spec.hpp"

#include <charconv>

#include "framework/graph/graph_spec.hpp"

namespace lightloom::study {
namespace {

template <typename T>
void append(std::vector<T>& list, const std::vector<T>& more) {
  list.insert(list.end(), more.begin(), more.end());
}

bool read_length(std::string_view text, uint32_t& length) {
  const auto result = std::from_chars(text.data(), text.data() + text.size(), length);
  return result.ec == std::errc{} && result.ptr == text.data() + text.size() && length >= 1 &&
         length <= kMaximumImageSize;
}

}  // namespace

Changes combine(Changes first, const Changes& second) {
  append(first.variants, second.variants);
  append(first.swaps, second.swaps);
  append(first.disables, second.disables);
  append(first.sets, second.sets);
  append(first.formats, second.formats);
  if (second.size) first.size = second.size;
  if (second.trace_size) first.trace_size = second.trace_size;
  if (second.general) first.general = second.general;
  return first;
}

LinkOptions link_options(const Changes& changes) {
  LinkOptions options;
  options.variants = changes.variants;
  options.swaps = changes.swaps;
  options.disables = changes.disables;
  options.sets = changes.sets;
  options.formats = changes.formats;
  options.view = changes.size;
  options.trace = changes.trace_size;
  options.general = changes.general.value_or(false);
  return options;
}

std::vector<std::string> command_options(const Changes& changes) {
  std::vector<std::string> options;
  const auto add = [&](const char* name, const std::string& value) {
    options.emplace_back(name);
    options.push_back(value);
  };
  if (changes.size) add("--size", size_text(*changes.size));
  if (changes.trace_size) add("--trace-size", size_text(*changes.trace_size));
  for (const std::string& variant : changes.variants) add("--variant", variant);
  for (const auto& [pass, type] : changes.swaps) add("--swap", pass + "=" + type);
  for (const std::string& glob : changes.disables) add("--disable", glob);
  for (const auto& [name, value] : changes.sets) add("--set", name + "=" + value);
  for (const auto& [values, format] : changes.formats) add("--store", values + "=" + format);
  if (changes.general.value_or(false)) options.emplace_back("--general");
  return options;
}

std::optional<Size> parse_size(std::string_view text) {
  const std::size_t cross = text.find('x');
  Size size;
  if (cross == std::string_view::npos || !read_length(text.substr(0, cross), size.first) ||
      !read_length(text.substr(cross + 1), size.second))
    return std::nullopt;
  return size;
}

std::string size_text(const Size& size) {
  return std::to_string(size.first) + "x" + std::to_string(size.second);
}

const std::vector<std::string>& metric_names() {
  static const std::vector<std::string> names = {"flip", "relmse",    "rmse",      "smape",      "mape",
                                                 "mse",  "psnr",      "ssim",      "mean_error", "max_error",
                                                 "bias", "fireflies", "non_finite"};
  return names;
}

}  // namespace lightloom::study
