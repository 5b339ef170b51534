#include "framework/graph/desc.hpp"

namespace lightloom {

std::string to_string(const Extent3& extent) {
  std::string text = std::to_string(extent.width) + "x" + std::to_string(extent.height);
  if (extent.depth != 1) text += "x" + std::to_string(extent.depth);
  return text;
}

std::string to_string(const ImageDesc& desc) {
  return std::string(format_info(desc.format).name) + " " + to_string(desc.extent);
}

uint64_t byte_size(const ImageDesc& desc) {
  return uint64_t{desc.extent.width} * desc.extent.height * desc.extent.depth *
         format_info(desc.format).bytes_per_texel;
}

}  // namespace lightloom
