#include "framework/image/compared_images.hpp"

#include <cmath>
#include <cstring>

#include "framework/base/error.hpp"
#include "framework/image/half.hpp"

namespace lightloom::image {
namespace {

void require_comparable(const HostImage& image, std::string_view role) {
  const auto fail = [role](const std::string& cause) {
    throw Error(ExitCode::invalid_input, "the " + std::string(role) + " cannot be compared: " + cause);
  };
  const Extent3& extent = image.desc.extent;
  const FormatInfo& format = format_info(image.desc.format);
  if (image.desc.dimension != Dimension::d2 || extent.depth != 1) fail("it is a volume, and images are wanted");
  if (extent.width == 0 || extent.height == 0) fail("it has no pixels (" + to_string(extent) + ")");
  if (format.numeric != NumericClass::floating) fail("it holds integers (" + std::string(format.name) + ")");
  if (format.channels == 2) fail("it has 2 channels, and 1, 3 or 4 are wanted");
  if (image.texels.size() != byte_size(image.desc)) {
    fail("it has " + std::to_string(image.texels.size()) + " bytes where " + to_string(image.desc) + " needs " +
         std::to_string(byte_size(image.desc)));
  }
}

template <typename T>
T load(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

float sample(const std::byte* from, ChannelType type) {
  switch (type) {
    case ChannelType::unorm8:
      return static_cast<float>(load<uint8_t>(from)) / 255.0f;
    case ChannelType::unorm16:
      return static_cast<float>(load<uint16_t>(from)) / 65535.0f;
    case ChannelType::half:
      return float_from_half(load<uint16_t>(from));
    case ChannelType::float32:
    case ChannelType::uint32:  // refused before
      break;
  }
  return load<float>(from);
}

bool is_finite(const Planes& planes, size_t pixel) {
  return std::isfinite(planes.channels[0][pixel]) && std::isfinite(planes.channels[1][pixel]) &&
         std::isfinite(planes.channels[2][pixel]);
}

}  // namespace

Planes planes_of(const HostImage& image, std::string_view role) {
  require_comparable(image, role);
  Planes planes{image.desc.extent.width, image.desc.extent.height, {}};
  const ChannelType type = channel_type(image.desc.format);
  const size_t channels = format_info(image.desc.format).channels;
  const size_t step = channel_bytes(type);
  for (size_t c = 0; c < 3; ++c) {
    std::vector<float>& plane = planes.channels[c];
    plane.resize(planes.pixel_count());
    const std::byte* from = image.texels.data() + (channels < 3 ? 0 : c * step);
    for (float& value : plane) {
      value = sample(from, type);
      from += channels * step;
    }
  }
  return planes;
}

double luminance(const Planes& planes, size_t pixel) {
  double sum = 0;
  for (size_t c = 0; c < 3; ++c) sum += kLuminanceWeights[c] * static_cast<double>(planes.channels[c][pixel]);
  return sum;
}

ComparedImages pair_images(const HostImage& reference, const HostImage& test) {
  ComparedImages pair;
  pair.reference = planes_of(reference, "reference");
  pair.test = planes_of(test, "test image");
  if (reference.desc.extent != test.desc.extent) {
    throw Error(ExitCode::invalid_input, "the images differ in size: the reference has " +
                                             to_string(reference.desc.extent) + " pixels, the test image " +
                                             to_string(test.desc.extent));
  }
  const size_t count = pair.reference.pixel_count();
  pair.usable.assign(count, 1);
  pair.reference_usable.assign(count, 1);
  for (size_t pixel = 0; pixel < count; ++pixel) {
    const bool reference_finite = is_finite(pair.reference, pixel);
    const bool test_finite = is_finite(pair.test, pixel);
    if (reference_finite && test_finite) continue;
    pair.usable[pixel] = 0;
    if (!reference_finite) {
      pair.reference_usable[pixel] = 0;
      ++pair.reference_non_finite;
    }
    if (!test_finite) ++pair.non_finite;
    for (size_t c = 0; c < 3; ++c) {
      if (!reference_finite) pair.reference.channels[c][pixel] = 0;
      pair.test.channels[c][pixel] = pair.reference.channels[c][pixel];
    }
  }
  for (const uint8_t flag : pair.usable) pair.usable_count += flag;
  return pair;
}

}  // namespace lightloom::image
