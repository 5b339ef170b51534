#include "framework/run/texel_text.hpp"

#include <bit>
#include <cmath>
#include <sstream>

#include "framework/base/text.hpp"
#include "framework/image/half.hpp"
#include "framework/image/host_image.hpp"

namespace lightloom::run {
namespace {

std::string number_text(double value) {
  // The sign of a NaN means nothing, and differs between devices.
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value < 0 ? "-inf" : "inf";
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string channel_text(image::ChannelType type, uint32_t raw) {
  switch (type) {
    case image::ChannelType::unorm8:
      return number_text(raw / 255.0);
    case image::ChannelType::unorm16:
      return number_text(raw / 65535.0);
    case image::ChannelType::half:
      return number_text(image::float_from_half(static_cast<uint16_t>(raw)));
    case image::ChannelType::float32:
      return number_text(std::bit_cast<float>(raw));
    case image::ChannelType::uint32:
      break;
  }
  return std::to_string(raw);
}

}  // namespace

uint64_t texel_count(const ImageDesc& desc) {
  return uint64_t{desc.extent.width} * desc.extent.height * desc.extent.depth;
}

std::vector<uint32_t> texel_coordinates(const ImageDesc& desc, uint32_t number) {
  const uint32_t row = number / desc.extent.width;
  std::vector<uint32_t> place = {number % desc.extent.width, row % desc.extent.height};
  if (desc.dimension == Dimension::d3) place.push_back(row / desc.extent.height);
  return place;
}

std::string texel_place(const ImageDesc& desc, uint32_t number) {
  std::vector<std::string> numbers;
  for (const uint32_t coordinate : texel_coordinates(desc, number)) numbers.push_back(std::to_string(coordinate));
  return join(numbers, ",");
}

std::vector<std::string> channel_texts(const ImageDesc& desc, const std::array<uint32_t, 4>& raw) {
  std::vector<std::string> texts;
  for (uint32_t channel = 0; channel < format_info(desc.format).channels; ++channel)
    texts.push_back(channel_text(image::channel_type(desc.format), raw[channel]));
  return texts;
}

std::string texel_text(const ImageDesc& desc, const std::array<uint32_t, 4>& raw) {
  return "(" + join(channel_texts(desc, raw), ", ") + ")";
}

}  // namespace lightloom::run
