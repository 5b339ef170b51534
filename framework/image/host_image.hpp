#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "framework/graph/desc.hpp"

namespace lightloom::image {

/// How one channel of a format is stored.
enum class ChannelType : uint8_t { unorm8, unorm16, half, float32, uint32 };

[[nodiscard]] ChannelType channel_type(Format format);
[[nodiscard]] size_t channel_bytes(ChannelType type);

/// Texels of one graph value on the host, tightly packed, x fastest, then y, then z, channels innermost.
struct HostImage {
  ImageDesc desc;
  std::vector<std::byte> texels;

  /// Channel value as a number: unorm formats give [0,1], half and float their value, uint the integer. Throws
  /// std::out_of_range outside the image.
  [[nodiscard]] double at(uint32_t x, uint32_t y, uint32_t z, uint32_t channel) const;
};

}  // namespace lightloom::image
