#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace lightloom::cli {

/// WIDTHxHEIGHT, both at least 1.
struct Size {
  uint32_t width = 0;
  uint32_t height = 0;
  bool operator==(const Size&) const = default;
};

/// FIRST..LAST, both inclusive; a single number N stands for N..N.
struct Range {
  uint32_t first = 0;
  uint32_t last = 0;
  bool operator==(const Range&) const = default;
};

/// NAME=VALUE; the value is all that follows the first '=' and may be empty.
struct Assignment {
  std::string name;
  std::string value;
  bool operator==(const Assignment&) const = default;
};

/// Each `parse_value` stores the value and returns "", or leaves it alone and returns what is wrong, fit to follow
/// "option '--x': ". Numbers must be finite, in range, and use all of the text.
[[nodiscard]] std::string parse_value(std::string_view text, std::string& value);
[[nodiscard]] std::string parse_value(std::string_view text, std::filesystem::path& value);
[[nodiscard]] std::string parse_value(std::string_view text, uint32_t& value);
[[nodiscard]] std::string parse_value(std::string_view text, int64_t& value);
[[nodiscard]] std::string parse_value(std::string_view text, double& value);
[[nodiscard]] std::string parse_value(std::string_view text, Size& value);
[[nodiscard]] std::string parse_value(std::string_view text, Range& value);
[[nodiscard]] std::string parse_value(std::string_view text, Assignment& value);

template <typename T>
[[nodiscard]] std::string parse_value(std::string_view text, std::optional<T>& value) {
  T parsed{};
  std::string problem = parse_value(text, parsed);
  if (problem.empty()) value = std::move(parsed);
  return problem;
}

/// Appends: the target of a repeated option.
template <typename T>
[[nodiscard]] std::string parse_value(std::string_view text, std::vector<T>& values) {
  T parsed{};
  std::string problem = parse_value(text, parsed);
  if (problem.empty()) values.push_back(std::move(parsed));
  return problem;
}

/// The value as a user would type it; "" where help should show no default.
[[nodiscard]] std::string format_value(const std::string& value);
[[nodiscard]] std::string format_value(const std::filesystem::path& value);
[[nodiscard]] std::string format_value(uint32_t value);
[[nodiscard]] std::string format_value(int64_t value);
[[nodiscard]] std::string format_value(double value);
[[nodiscard]] std::string format_value(const Size& value);
[[nodiscard]] std::string format_value(const Range& value);
[[nodiscard]] std::string format_value(const Assignment& value);

/// What kind of value a target takes, as far as help and completion care.
template <typename T>
struct ValueKind {
  static constexpr bool kRepeated = false;
  static constexpr bool kOptional = false;
  using Element = T;
};
template <typename T>
struct ValueKind<std::optional<T>> {
  static constexpr bool kRepeated = false;
  static constexpr bool kOptional = true;
  using Element = T;
};
template <typename T>
struct ValueKind<std::vector<T>> {
  static constexpr bool kRepeated = true;
  static constexpr bool kOptional = true;
  using Element = T;
};

/// Placeholder in help: N, NUMBER, WxH, A..B, NAME=VALUE, FILE, TEXT.
template <typename T>
[[nodiscard]] constexpr std::string_view value_placeholder() {
  if constexpr (std::is_same_v<T, Size>) return "WxH";
  if constexpr (std::is_same_v<T, Range>) return "A..B";
  if constexpr (std::is_same_v<T, Assignment>) return "NAME=VALUE";
  if constexpr (std::is_same_v<T, std::filesystem::path>) return "FILE";
  if constexpr (std::is_integral_v<T>) return "N";
  if constexpr (std::is_floating_point_v<T>) return "NUMBER";
  return "TEXT";
}

}  // namespace lightloom::cli
