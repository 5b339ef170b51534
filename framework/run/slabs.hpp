#pragma once

#include <cstdint>
#include <vector>

#include "framework/gpu/transfer.hpp"
#include "framework/graph/desc.hpp"

namespace lightloom::run {

/// A piece of an image that holds consecutive texels: x fastest, then y, then z.
struct Slab {
  Extent3 offset{0, 0, 0};   ///< of its first texel
  Extent3 extent;            ///< whole rows, and several slices only where they are whole
  uint32_t first_texel = 0;  ///< number of its first texel in the image
  uint32_t texels = 0;
};

/// Cuts an image into slabs of at most `most_bytes`, or of one row where a row has more, in order.
[[nodiscard]] std::vector<Slab> slabs_of(const ImageDesc& desc, uint64_t most_bytes);

/// A slab as a region of an image of this shape, or of one layer of it.
[[nodiscard]] gpu::ImageRegion region_of(const Slab& slab, uint32_t layer);

/// Bytes of the largest slab.
[[nodiscard]] uint64_t largest_slab_bytes(const ImageDesc& desc, uint64_t most_bytes);

}  // namespace lightloom::run
