#include "framework/cli/argument_values.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>
#include <system_error>

#include "framework/base/text.hpp"

namespace lightloom::cli {
namespace {

std::string expected(const std::string& what, std::string_view got) {
  return "expected " + what + ", got " + in_quotes(got);
}

/// All of the text as a number.
template <typename T>
bool parse_all(std::string_view text, T& value) {
  T parsed{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), parsed);
  if (error != std::errc{} || end != text.data() + text.size() || text.empty()) return false;
  value = parsed;
  return true;
}

template <typename T>
std::string parse_integer(std::string_view text, T& value) {
  if (parse_all(text, value)) return {};
  return expected("a whole number from " + std::to_string(std::numeric_limits<T>::min()) + " to " +
                      std::to_string(std::numeric_limits<T>::max()),
                  text);
}

}  // namespace

std::string parse_value(std::string_view text, std::string& value) {
  value = text;
  return {};
}

std::string parse_value(std::string_view text, std::filesystem::path& value) {
  if (text.empty()) return "expected a path, got an empty text";
  value = text;
  return {};
}

std::string parse_value(std::string_view text, uint32_t& value) {
  return parse_integer(text, value);
}

std::string parse_value(std::string_view text, int64_t& value) {
  return parse_integer(text, value);
}

std::string parse_value(std::string_view text, double& value) {
  double parsed = 0;
  if (!parse_all(text, parsed) || !std::isfinite(parsed)) return expected("a number", text);
  value = parsed;
  return {};
}

std::string parse_value(std::string_view text, Size& value) {
  Size parsed;
  const size_t cross = text.find('x');
  if (cross == std::string_view::npos || !parse_all(text.substr(0, cross), parsed.width) ||
      !parse_all(text.substr(cross + 1), parsed.height)) {
    return expected("WIDTHxHEIGHT such as 640x480", text);
  }
  if (parsed.width == 0 || parsed.height == 0) return expected("a width and a height of at least 1", text);
  value = parsed;
  return {};
}

std::string parse_value(std::string_view text, Range& value) {
  Range parsed;
  const size_t dots = text.find("..");
  const bool single = dots == std::string_view::npos;
  if (!parse_all(text.substr(0, dots), parsed.first) || (!single && !parse_all(text.substr(dots + 2), parsed.last))) {
    return expected("FIRST..LAST such as 0..15, or one number", text);
  }
  if (single) parsed.last = parsed.first;
  if (parsed.last < parsed.first) return expected("a range that does not end before it begins", text);
  value = parsed;
  return {};
}

std::string parse_value(std::string_view text, Assignment& value) {
  const size_t equals = text.find('=');
  if (equals == std::string_view::npos || equals == 0) return expected("NAME=VALUE", text);
  value = {std::string(text.substr(0, equals)), std::string(text.substr(equals + 1))};
  return {};
}

std::string format_value(const std::string& value) {
  return value;
}
std::string format_value(const std::filesystem::path& value) {
  return value.string();
}
std::string format_value(uint32_t value) {
  return std::to_string(value);
}
std::string format_value(int64_t value) {
  return std::to_string(value);
}

std::string format_value(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string format_value(const Size& value) {
  return value == Size{} ? "" : std::to_string(value.width) + "x" + std::to_string(value.height);
}

std::string format_value(const Range& value) {
  return value.first == value.last ? std::to_string(value.first)
                                   : std::to_string(value.first) + ".." + std::to_string(value.last);
}

std::string format_value(const Assignment& value) {
  return value.name.empty() ? "" : value.name + "=" + value.value;
}

}  // namespace lightloom::cli
