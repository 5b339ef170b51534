#include "framework/image/host_image.hpp"

#include <cstring>
#include <stdexcept>

#include "framework/image/half.hpp"

namespace lightloom::image {
namespace {

template <typename T>
T load(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  return value;
}

}  // namespace

ChannelType channel_type(Format format) {
  switch (format) {
    case Format::r8_unorm:
    case Format::rgba8_unorm:
      return ChannelType::unorm8;
    case Format::rgba16_unorm:
      return ChannelType::unorm16;
    case Format::r16_sfloat:
    case Format::rg16_sfloat:
    case Format::rgba16_sfloat:
      return ChannelType::half;
    case Format::r32_sfloat:
    case Format::rg32_sfloat:
    case Format::rgba32_sfloat:
    case Format::d32_sfloat:
      return ChannelType::float32;
    case Format::r32_uint:
    case Format::rg32_uint:
    case Format::rgba32_uint:
      return ChannelType::uint32;
  }
  throw std::logic_error("unknown format");
}

size_t channel_bytes(ChannelType type) {
  switch (type) {
    case ChannelType::unorm8:
      return 1;
    case ChannelType::unorm16:
    case ChannelType::half:
      return 2;
    case ChannelType::float32:
    case ChannelType::uint32:
      return 4;
  }
  throw std::logic_error("unknown channel type");
}

double HostImage::at(uint32_t x, uint32_t y, uint32_t z, uint32_t channel) const {
  const Extent3& extent = desc.extent;
  const uint32_t channels = format_info(desc.format).channels;
  if (x >= extent.width || y >= extent.height || z >= extent.depth || channel >= channels) {
    throw std::out_of_range("texel outside the image");
  }
  const ChannelType type = channel_type(desc.format);
  const size_t texel = (static_cast<size_t>(z) * extent.height + y) * extent.width + x;
  const size_t offset = (texel * channels + channel) * channel_bytes(type);
  if (offset + channel_bytes(type) > texels.size()) throw std::out_of_range("the image has too few texels");
  const std::byte* from = texels.data() + offset;
  switch (type) {
    case ChannelType::unorm8:
      return static_cast<double>(load<uint8_t>(from)) / 255.0;
    case ChannelType::unorm16:
      return static_cast<double>(load<uint16_t>(from)) / 65535.0;
    case ChannelType::half:
      return static_cast<double>(float_from_half(load<uint16_t>(from)));
    case ChannelType::float32:
      return static_cast<double>(load<float>(from));
    case ChannelType::uint32:
      return static_cast<double>(load<uint32_t>(from));
  }
  throw std::logic_error("unknown channel type");
}

}  // namespace lightloom::image
