#include "framework/image/png.hpp"

#include <algorithm>

#include "framework/base/error.hpp"
#include "framework/image/oiio_io.hpp"

namespace lightloom::image {
namespace {

constexpr size_t kRed = 0, kGreen = 1, kBlue = 2, kAlpha = 3;

/// Grey, grey + alpha, RGB or RGBA to RGBA.
std::vector<std::byte> spread_to_rgba(const std::vector<std::byte>& samples, size_t channels) {
  const size_t count = samples.size() / channels;
  const bool grey = channels < 3;
  const bool has_alpha = channels == 2 || channels == 4;
  std::vector<std::byte> rgba(count * 4);
  for (size_t i = 0; i < count; ++i) {
    const std::byte* from = samples.data() + i * channels;
    std::byte* to = rgba.data() + i * 4;
    to[kRed] = from[0];
    to[kGreen] = grey ? from[0] : from[1];
    to[kBlue] = grey ? from[0] : from[2];
    to[kAlpha] = has_alpha ? from[channels - 1] : std::byte{255};
  }
  return rgba;
}

}  // namespace

void write_png(const std::filesystem::path& file, const HostImage& image) {
  require_complete(image, file);
  const Extent3& extent = image.desc.extent;
  if (image.desc.format != Format::rgba8_unorm || extent.depth != 1) {
    throw Error(ExitCode::run_failed, "cannot write '" + file.string() +
                                          "': PNG files here hold 2D rgba8_unorm images, and this one is " +
                                          to_string(image.desc));
  }
  const size_t count = static_cast<size_t>(extent.width) * extent.height;
  std::vector<std::byte> rgb(count * 3);
  for (size_t i = 0; i < count; ++i) std::copy_n(image.texels.data() + i * 4, 3, rgb.data() + i * 3);
  OIIO::ImageSpec spec(static_cast<int>(extent.width), static_cast<int>(extent.height), 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  encode_and_write(file, "png", spec, rgb.data());
}

HostImage read_png(const std::filesystem::path& file) {
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  const std::unique_ptr<OIIO::ImageInput> input = open_image(file, "png", config);
  const OIIO::ImageSpec& spec = input->spec();
  const auto channels = static_cast<size_t>(spec.nchannels);
  HostImage image;
  image.desc = {
      Format::rgba8_unorm, Dimension::d2, {static_cast<uint32_t>(spec.width), static_cast<uint32_t>(spec.height), 1}};
  std::vector<std::byte> samples(static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height) * channels);
  read_samples(*input, file, OIIO::TypeDesc::UINT8, samples.data());
  image.texels = spread_to_rgba(samples, channels);
  return image;
}

}  // namespace lightloom::image
