#include <algorithm>
#include <charconv>
#include <utility>

#include "framework/base/text.hpp"
#include "framework/graph/graph_spec.hpp"

namespace lightloom {
namespace {

std::optional<uint32_t> parse_age(std::string_view text) {
  uint32_t age = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), age);
  if (text.empty() || result.ec != std::errc{} || result.ptr != text.data() + text.size()) return std::nullopt;
  return age;
}

/// "k" or "a..b" into the edge; a sentence if that fails.
std::string parse_ages(std::string_view text, EdgeSpec& edge) {
  const std::size_t dots = text.find("..");
  const bool range = dots != std::string_view::npos;
  const auto first = parse_age(text.substr(0, dots));
  const auto last = range ? parse_age(text.substr(dots + 2)) : first;
  if (!first || !last) return "what follows '@' must be a number of frames, or a range a..b";
  if (*first < 1) return "ages count from 1 (the previous frame); this frame's value has no '@'";
  if (*last < *first) return "the range of ages runs backwards";
  if (*last > kMaximumAge) return "the oldest age may be " + std::to_string(kMaximumAge);
  edge.first_age = *first;
  edge.last_age = *last;
  return {};
}

}  // namespace

bool is_name(std::string_view text) {
  const auto lower = [](char c) { return c >= 'a' && c <= 'z'; };
  return !text.empty() && lower(text.front()) &&
         std::all_of(text.begin(), text.end(), [&](char c) { return lower(c) || (c >= '0' && c <= '9') || c == '_'; });
}

EdgeParse parse_edge(std::string_view text) {
  EdgeSpec edge;
  edge.text = text;
  const std::size_t at = text.find('@');
  std::vector<std::string> names = split(text.substr(0, at), '.');
  if (names.size() < 2 || names.size() > 3 || !std::all_of(names.begin(), names.end(), is_name))
    return {std::nullopt, "an edge is written \"pass.port\" or \"pass.port.part\""};
  if (at != std::string_view::npos) {
    std::string problem = parse_ages(text.substr(at + 1), edge);
    if (!problem.empty()) return {std::nullopt, std::move(problem)};
  }
  edge.pass = std::move(names[0]);
  edge.port = std::move(names[1]);
  if (names.size() == 3) edge.part = std::move(names[2]);
  return {std::move(edge), {}};
}

}  // namespace lightloom
