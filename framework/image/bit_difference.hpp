#pragma once

#include <array>
#include <cstdint>

#include "framework/image/host_image.hpp"

namespace lightloom::image {

/// How two images of one shape differ.
struct BitDifference {
  uint64_t texels = 0;  ///< that differ in any bit
  /// The channel that differs most: where it is, and what each image has there. A number against NaN or another
  /// infinity counts as more than any difference of numbers; NaNs of different bits as less.
  std::array<uint32_t, 3> place{0, 0, 0};
  uint32_t channel = 0;
  double one = 0;
  double other = 0;
};

/// Throws std::invalid_argument for images of different shapes.
[[nodiscard]] BitDifference bit_difference(const HostImage& one, const HostImage& other);

}  // namespace lightloom::image
