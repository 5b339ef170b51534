#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "framework/image/host_image.hpp"

namespace lightloom::image {

/// Three channels, each a plane of width * height floats, row 0 on top. All three are the same for grey images.
struct Planes {
  uint32_t width = 0;
  uint32_t height = 0;
  std::array<std::vector<float>, 3> channels;

  [[nodiscard]] size_t pixel_count() const { return size_t{width} * height; }
};

/// Values as they are. Throws Error(invalid_input) as `compare` says; `role` names the image in the message.
[[nodiscard]] Planes planes_of(const HostImage& image, std::string_view role);

/// Luminance weights of linear R, G and B with the primaries of Rec. 709 (ITU-R BT.709).
constexpr std::array<double, 3> kLuminanceWeights = {0.2126, 0.7152, 0.0722};
[[nodiscard]] double luminance(const Planes& planes, size_t pixel);

/// Two images of one size, all values finite. Where the test was not finite, it holds the reference's value, and where
/// the reference was not, both hold 0, so that filters see no error there.
struct ComparedImages {
  Planes reference;
  Planes test;
  std::vector<uint8_t> usable;            ///< by pixel: 1 where both were finite
  std::vector<uint8_t> reference_usable;  ///< by pixel: 1 where the reference was
  uint64_t usable_count = 0;
  uint64_t non_finite = 0;            ///< pixels of the test
  uint64_t reference_non_finite = 0;  ///< pixels of the reference
};

/// Throws Error(invalid_input) as `compare` says.
[[nodiscard]] ComparedImages pair_images(const HostImage& reference, const HostImage& test);

}  // namespace lightloom::image
