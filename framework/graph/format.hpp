#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lightloom {

/// Texel formats of graph values. Names follow Vulkan's, in lower case.
enum class Format : uint8_t {
  r8_unorm,
  rgba8_unorm,
  rgba16_unorm,
  r16_sfloat,
  rg16_sfloat,
  rgba16_sfloat,
  r32_sfloat,
  rg32_sfloat,
  rgba32_sfloat,
  r32_uint,
  rg32_uint,
  rgba32_uint,
  d32_sfloat,
};

/// What a shader sees when it reads the format: `texture2D` or `utexture2D`.
enum class NumericClass : uint8_t { floating, unsigned_integer };

/// What the bits of a channel mean: `unorm` v / (2^bits - 1), `sfloat` IEEE 754, `uint` themselves.
enum class Encoding : uint8_t { unorm, sfloat, uint };

struct FormatInfo {
  std::string_view name;
  uint32_t bytes_per_texel;
  uint32_t channels;
  NumericClass numeric;
  bool depth;
  Encoding encoding;
};

[[nodiscard]] const FormatInfo& format_info(Format format);
[[nodiscard]] uint32_t channel_bits(Format format);
/// Largest finite number of a channel: 65504 for half floats, 1 for unorm.
[[nodiscard]] float largest_number(Format format);
/// The format of this name; depth formats are none that a graph may name.
[[nodiscard]] std::optional<Format> find_format(std::string_view name);
/// Names of all formats but those for depth.
[[nodiscard]] std::vector<std::string> format_names();
/// Formats that hold the same kind of numbers in as many channels, `format` among them: a value of one may be stored in
/// another, wider or narrower.
[[nodiscard]] std::vector<Format> storage_choices(Format format);

}  // namespace lightloom
