#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "framework/graph/format.hpp"

namespace lightloom {

/// Size in texels; depth is 1 for 2D images.
struct Extent3 {
  uint32_t width = 1;
  uint32_t height = 1;
  uint32_t depth = 1;
  bool operator==(const Extent3&) const = default;
};

enum class Dimension : uint8_t { d2, d3 };

/// Where the extent of a value comes from.
enum class ExtentRule : uint8_t {
  any,    ///< inputs only: whatever is connected
  view,   ///< the graph's `view` size
  trace,  ///< the graph's `trace` size
  grid,   ///< the voxel grid of the scene at the node's integer param `resolution`
  like,   ///< same as the input port named in `Port::like`; the view's where that one is optional and unconnected
  fixed,  ///< `Port::fixed_extent`, whatever the scene and the graph
};

/// Concrete shape of one image.
struct ImageDesc {
  Format format = Format::rgba16_sfloat;
  Dimension dimension = Dimension::d2;
  Extent3 extent;
  bool operator==(const ImageDesc&) const = default;
};

using ClearColor = std::array<float, 4>;

[[nodiscard]] std::string to_string(const Extent3& extent);  ///< "640x480" or "128x54x79"
[[nodiscard]] std::string to_string(const ImageDesc& desc);  ///< "rgba16_sfloat 640x480"
[[nodiscard]] uint64_t byte_size(const ImageDesc& desc);     ///< tightly packed [bytes]

}  // namespace lightloom
