#include "framework/image/dumped_image.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "framework/base/error.hpp"
#include "framework/image/exr.hpp"
#include "framework/image/half.hpp"
#include "framework/image/npy.hpp"

namespace lightloom::image {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& has, const ImageDesc& desc) {
  throw Error(ExitCode::invalid_input, "'" + file.string() + "' " + has + ", and the value is " + to_string(desc));
}

HostImage from_npy(const std::filesystem::path& file, const ImageDesc& desc) {
  HostImage image = read_npy(file);
  if (image.desc.dimension != desc.dimension || image.desc.extent != desc.extent ||
      channel_type(image.desc.format) != channel_type(desc.format) ||
      format_info(image.desc.format).channels != format_info(desc.format).channels)
    fail(file, "holds " + to_string(image.desc), desc);
  image.desc = desc;
  return image;
}

/// 8-bit channels were written as v / 255 in half, which keeps all 256 values apart.
std::byte unorm8_from_half(const std::byte* from) {
  uint16_t half = 0;
  std::memcpy(&half, from, sizeof half);
  return static_cast<std::byte>(std::lround(static_cast<double>(float_from_half(half)) * 255));
}

/// 16-bit channels were written as v / 65535 in 32-bit floats.
std::array<std::byte, 2> unorm16_from_float(const std::byte* from) {
  float number = 0;
  std::memcpy(&number, from, sizeof number);
  return std::bit_cast<std::array<std::byte, 2>>(
      static_cast<uint16_t>(std::lround(static_cast<double>(number) * 65535)));
}

/// How a channel stands in the file.
ChannelType written_as(ChannelType type) {
  if (type == ChannelType::unorm8) return ChannelType::half;
  return type == ChannelType::unorm16 ? ChannelType::float32 : type;
}

/// A sample of the file as the device had it.
void copy_channel(std::byte* to, const std::byte* from, ChannelType type) {
  if (type == ChannelType::unorm8)
    *to = unorm8_from_half(from);
  else if (type == ChannelType::unorm16)
    std::memcpy(to, unorm16_from_float(from).data(), 2);
  else
    std::memcpy(to, from, channel_bytes(type));
}

/// Where each wanted channel is in the file, which orders them in its own way.
std::vector<size_t> places_of(const std::filesystem::path& file, const ExrImage& exr, const ImageDesc& desc,
                              const std::vector<std::string>& names) {
  std::vector<size_t> places;
  for (const std::string& name : names) {
    const auto found = std::find(exr.channels.begin(), exr.channels.end(), name);
    if (found == exr.channels.end()) fail(file, "has no channel '" + name + "'", desc);
    places.push_back(static_cast<size_t>(found - exr.channels.begin()));
  }
  return places;
}

HostImage from_exr(const std::filesystem::path& file, const ImageDesc& desc, const std::vector<std::string>& names) {
  const ExrImage exr = read_exr(file);
  const ChannelType type = channel_type(desc.format);
  if (exr.width != desc.extent.width || exr.height != desc.extent.height || desc.extent.depth != 1)
    fail(file, "is " + to_string(Extent3{exr.width, exr.height, 1}), desc);
  if (exr.type != written_as(type)) fail(file, "has samples of another type", desc);
  if (exr.channels.size() != names.size()) fail(file, "has " + std::to_string(exr.channels.size()) + " channels", desc);
  const std::vector<size_t> places = places_of(file, exr, desc, names);
  HostImage image{desc, std::vector<std::byte>(byte_size(desc))};
  const size_t stored = channel_bytes(exr.type);
  std::byte* to = image.texels.data();
  for (size_t texel = 0; texel < size_t{exr.width} * exr.height; ++texel) {
    for (const size_t place : places) {
      copy_channel(to, exr.samples.data() + (texel * names.size() + place) * stored, type);
      to += channel_bytes(type);
    }
  }
  return image;
}

}  // namespace

HostImage read_dumped(const std::filesystem::path& file, const ImageDesc& desc,
                      const std::vector<std::string>& channel_names) {
  return file.extension() == ".npy" ? from_npy(file, desc) : from_exr(file, desc, channel_names);
}

}  // namespace lightloom::image
