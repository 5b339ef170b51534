#pragma once

#include <cstdint>

#include "framework/image/host_image.hpp"

namespace lightloom::image {

/// Pixels x..x + width, y..y + height, from the upper left corner.
struct PixelBox {
  uint32_t x = 0;
  uint32_t y = 0;
  uint32_t width = 1;
  uint32_t height = 1;
};

/// The part of a 2D image within the box. Throws Error(invalid_input) where the box is empty or reaches beyond it.
[[nodiscard]] HostImage crop(const HostImage& image, const PixelBox& box);

}  // namespace lightloom::image
