#include "framework/run/slabs.hpp"

#include <algorithm>

namespace lightloom::run {

std::vector<Slab> slabs_of(const ImageDesc& desc, uint64_t most_bytes) {
  const Extent3& whole = desc.extent;
  const uint64_t row_bytes = uint64_t{whole.width} * format_info(desc.format).bytes_per_texel;
  const auto most_rows = static_cast<uint32_t>(std::clamp<uint64_t>(most_bytes / row_bytes, 1, UINT32_MAX));
  const uint32_t rows = std::min(most_rows, whole.height);
  const uint32_t slices = rows == whole.height ? std::min(most_rows / whole.height, whole.depth) : 1;
  std::vector<Slab> slabs;
  for (uint32_t z = 0; z < whole.depth; z += slices)
    for (uint32_t y = 0; y < whole.height; y += rows) {
      const Extent3 extent{whole.width, std::min(rows, whole.height - y), std::min(slices, whole.depth - z)};
      slabs.push_back({.offset = {0, y, z},
                       .extent = extent,
                       .first_texel = (z * whole.height + y) * whole.width,
                       .texels = extent.width * extent.height * extent.depth});
    }
  return slabs;
}

gpu::ImageRegion region_of(const Slab& slab, uint32_t layer) {
  return {.layer = layer,
          .mip_level = 0,
          .offset = {static_cast<int32_t>(slab.offset.width), static_cast<int32_t>(slab.offset.height),
                     static_cast<int32_t>(slab.offset.depth)},
          .extent = slab.extent};
}

uint64_t largest_slab_bytes(const ImageDesc& desc, uint64_t most_bytes) {
  return uint64_t{slabs_of(desc, most_bytes).front().texels} * format_info(desc.format).bytes_per_texel;
}

}  // namespace lightloom::run
