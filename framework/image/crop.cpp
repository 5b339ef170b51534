#include "framework/image/crop.hpp"

#include <algorithm>

#include "framework/base/error.hpp"

namespace lightloom::image {

HostImage crop(const HostImage& image, const PixelBox& box) {
  const Extent3& extent = image.desc.extent;
  const bool inside = image.desc.dimension == Dimension::d2 && box.width > 0 && box.height > 0 &&
                      uint64_t{box.x} + box.width <= extent.width && uint64_t{box.y} + box.height <= extent.height;
  if (!inside) {
    throw Error(ExitCode::invalid_input, "the part of " + to_string(Extent3{box.width, box.height, 1}) + " pixels at " +
                                             std::to_string(box.x) + "," + std::to_string(box.y) +
                                             " does not lie within an image of " + to_string(extent));
  }
  HostImage part;
  part.desc = image.desc;
  part.desc.extent = {box.width, box.height, 1};
  part.texels.resize(byte_size(part.desc));
  const size_t texel = format_info(image.desc.format).bytes_per_texel;
  for (uint32_t row = 0; row < box.height; ++row) {
    const std::byte* from = image.texels.data() + ((size_t{box.y} + row) * extent.width + box.x) * texel;
    std::copy_n(from, box.width * texel, part.texels.data() + size_t{row} * box.width * texel);
  }
  return part;
}

}  // namespace lightloom::image
