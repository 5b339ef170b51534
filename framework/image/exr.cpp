#include "framework/image/exr.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <stdexcept>

#include "framework/base/error.hpp"
#include "framework/image/half.hpp"
#include "framework/image/oiio_io.hpp"

namespace lightloom::image {
namespace {

constexpr std::array<std::string_view, 6> kVectorWords = {"position", "normal",    "tangent",
                                                          "motion",   "direction", "velocity"};

bool is_vector(std::string_view name) {
  return std::any_of(kVectorWords.begin(), kVectorWords.end(),
                     [name](std::string_view word) { return name.find(word) != std::string_view::npos; });
}

OIIO::TypeDesc sample_type(ChannelType type) {
  switch (type) {
    case ChannelType::unorm8:
    case ChannelType::half:
      return OIIO::TypeDesc::HALF;
    case ChannelType::unorm16:
    case ChannelType::float32:
      return OIIO::TypeDesc::FLOAT;
    case ChannelType::uint32:
      return OIIO::TypeDesc::UINT32;
  }
  throw std::logic_error("unknown channel type");
}

std::vector<std::byte> half_from_unorm8(std::span<const std::byte> texels) {
  std::vector<std::byte> halves(texels.size() * sizeof(uint16_t));
  for (size_t i = 0; i < texels.size(); ++i) {
    const uint16_t half = half_from_float(static_cast<float>(std::to_integer<uint8_t>(texels[i])) / 255.0f);
    std::memcpy(halves.data() + i * sizeof half, &half, sizeof half);
  }
  return halves;
}

std::vector<std::byte> float_from_unorm16(std::span<const std::byte> texels) {
  std::vector<std::byte> floats(texels.size() * 2);
  for (size_t i = 0; i < texels.size() / 2; ++i) {
    uint16_t steps = 0;
    std::memcpy(&steps, texels.data() + i * sizeof steps, sizeof steps);
    const float number = static_cast<float>(steps) / 65535.0f;
    std::memcpy(floats.data() + i * sizeof number, &number, sizeof number);
  }
  return floats;
}

ChannelType stored_type(const OIIO::ImageSpec& spec) {
  if (!spec.channelformats.empty()) return ChannelType::float32;
  if (spec.format == OIIO::TypeDesc::HALF) return ChannelType::half;
  if (spec.format == OIIO::TypeDesc::UINT32) return ChannelType::uint32;
  return ChannelType::float32;
}

}  // namespace

std::vector<std::string> default_channel_names(const ImageDesc& desc, std::string_view port, std::string_view part) {
  const std::string_view name = part.empty() ? port : part;
  const uint32_t channels = format_info(desc.format).channels;
  if (channels == 1) return {std::string(name)};
  if (name == "id") {
    std::vector<std::string> names = {"object", "material", "triangle", "weights"};
    names.resize(channels);
    return names;
  }
  if (channels == 2) return {"X", "Y"};
  return is_vector(name) ? std::vector<std::string>{"X", "Y", "Z", "W"} : std::vector<std::string>{"R", "G", "B", "A"};
}

void write_exr(const std::filesystem::path& file, const HostImage& image,
               const std::vector<std::string>& channel_names) {
  const auto fail = [&file](const std::string& cause) {
    throw Error(ExitCode::run_failed, "cannot write '" + file.string() + "': " + cause);
  };
  require_complete(image, file);
  const Extent3& extent = image.desc.extent;
  const uint32_t channels = format_info(image.desc.format).channels;
  if (extent.depth != 1) fail("EXR files hold 2D images, and this one is " + to_string(image.desc));
  if (channel_names.size() != channels) {
    fail(std::to_string(channel_names.size()) + " channel names for " + std::to_string(channels) + " channels");
  }
  const ChannelType type = channel_type(image.desc.format);
  OIIO::ImageSpec spec(static_cast<int>(extent.width), static_cast<int>(extent.height), static_cast<int>(channels),
                       sample_type(type));
  spec.channelnames = channel_names;
  spec.attribute("compression", "zip");
  // OpenImageIO writes the time of day otherwise; equal images are to be equal files.
  spec.attribute("DateTime", "");
  if (type == ChannelType::unorm8) {
    encode_and_write(file, "openexr", spec, half_from_unorm8(image.texels).data());
  } else if (type == ChannelType::unorm16) {
    encode_and_write(file, "openexr", spec, float_from_unorm16(image.texels).data());
  } else {
    encode_and_write(file, "openexr", spec, image.texels.data());
  }
}

ExrImage read_exr(const std::filesystem::path& file) {
  const std::unique_ptr<OIIO::ImageInput> input = open_image(file, "openexr", OIIO::ImageSpec());
  const OIIO::ImageSpec& spec = input->spec();
  ExrImage image;
  image.width = static_cast<uint32_t>(spec.width);
  image.height = static_cast<uint32_t>(spec.height);
  image.type = stored_type(spec);
  image.channels = spec.channelnames;
  image.samples.resize(static_cast<size_t>(image.width) * image.height * image.channels.size() *
                       channel_bytes(image.type));
  read_samples(*input, file, sample_type(image.type), image.samples.data());
  return image;
}

double ExrImage::at(uint32_t x, uint32_t y, std::string_view channel) const {
  const auto found = std::find(channels.begin(), channels.end(), channel);
  if (x >= width || y >= height || found == channels.end()) throw std::out_of_range("sample outside the EXR image");
  const size_t index =
      (static_cast<size_t>(y) * width + x) * channels.size() + static_cast<size_t>(found - channels.begin());
  const std::byte* from = samples.data() + index * channel_bytes(type);
  const auto load = [from]<typename T>(T value) {
    std::memcpy(&value, from, sizeof value);
    return value;
  };
  if (type == ChannelType::half) return static_cast<double>(float_from_half(load(uint16_t{})));
  if (type == ChannelType::uint32) return static_cast<double>(load(uint32_t{}));
  return static_cast<double>(load(float{}));
}

}  // namespace lightloom::image
