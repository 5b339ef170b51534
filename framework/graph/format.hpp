#pragma once

#include <cstdint>
#include <string_view>

namespace lightloom {

/// Texel formats of graph values. Names follow Vulkan's, in lower case.
enum class Format : uint8_t {
  r8_unorm,
  rgba8_unorm,
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

struct FormatInfo {
  std::string_view name;
  uint32_t bytes_per_texel;
  uint32_t channels;
  NumericClass numeric;
  bool depth;
};

[[nodiscard]] const FormatInfo& format_info(Format format);

}  // namespace lightloom
