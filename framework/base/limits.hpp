#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace lightloom {

/// What an input file may ask for. Files are checked against these before anything is allocated for what they claim,
/// so that a small file cannot take all memory or hours of time. The defaults let all but the largest real scenes
/// through; docs/hostile_input.md lists them.
struct Limits {
  uint64_t file_bytes = uint64_t{512} << 20;
  uint64_t total_bytes = uint64_t{1} << 30;
  uint64_t json_bytes = uint64_t{128} << 20;
  uint64_t json_depth = 200;
  uint64_t json_values = 4'000'000;
  uint64_t elements = 200'000;
  uint64_t name_bytes = 1024;
  uint64_t nodes = 200'000;
  uint64_t node_depth = 1000;
  uint64_t vertices = uint64_t{1} << 23;
  uint64_t triangles = uint64_t{1} << 24;
  uint64_t accessor_values = uint64_t{1} << 27;
  uint64_t animation_values = uint64_t{1} << 25;
  uint64_t morph_weights = uint64_t{1} << 22;
  uint64_t joints = uint64_t{1} << 20;
  uint64_t posed_elements = uint64_t{1} << 33;
  uint64_t images = 4096;
  uint64_t image_side = 16384;
  uint64_t image_texels = uint64_t{1} << 26;
  uint64_t float_texels = uint64_t{1} << 25;
  uint64_t texture_texels = uint64_t{1} << 27;
  uint64_t page_texels = uint64_t{1} << 28;
  uint64_t jpeg_scans = 100;
};

/// One row of the table of limits.
struct LimitInfo {
  std::string_view name;  ///< in `--limit NAME=VALUE`
  uint64_t Limits::*value;
  std::string_view noun;  ///< what is counted, in messages: "nodes"
  std::string_view doc;   ///< whose, and why
  uint64_t most;          ///< the largest value that can be set: beyond it, something other than memory breaks
};

[[nodiscard]] std::span<const LimitInfo> limit_table();

/// Sets the limit of that name. Returns "", or what is wrong with the name or the value, fit to follow a colon.
[[nodiscard]] std::string set_limit(Limits& limits, std::string_view name, std::string_view value);

/// Throws Error(invalid_input) "ELEMENT has CLAIMED NOUN, more than the limit of N", with the option that raises the
/// limit as hint.
[[noreturn]] void refuse_beyond(const Limits& limits, uint64_t Limits::*limit, const std::string& element,
                                uint64_t claimed);

/// refuse_beyond where `claimed` is above the limit.
inline void require_within(const Limits& limits, uint64_t Limits::*limit, const std::string& element,
                           uint64_t claimed) {
  if (claimed > limits.*limit) refuse_beyond(limits, limit, element, claimed);
}

/// The sum, or the largest number there is.
[[nodiscard]] constexpr uint64_t add_saturated(uint64_t a, uint64_t b) {
  return a + b < a ? ~uint64_t{0} : a + b;
}
[[nodiscard]] constexpr uint64_t multiply_saturated(uint64_t a, uint64_t b) {
  return a != 0 && b > ~uint64_t{0} / a ? ~uint64_t{0} : a * b;
}

}  // namespace lightloom
