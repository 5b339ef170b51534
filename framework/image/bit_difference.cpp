#include "framework/image/bit_difference.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace lightloom::image {
namespace {

double distance(double one, double other) {
  if (std::isnan(one) && std::isnan(other)) return 0;
  const double distance = std::abs(one - other);
  if (std::isnan(distance)) return std::isnan(one) == std::isnan(other) ? 0 : std::numeric_limits<double>::infinity();
  return distance;
}

}  // namespace

BitDifference bit_difference(const HostImage& one, const HostImage& other) {
  if (one.desc != other.desc || one.texels.size() != byte_size(one.desc) || other.texels.size() != one.texels.size())
    throw std::invalid_argument("images of different shapes");
  const Extent3& extent = one.desc.extent;
  const size_t texel_bytes = format_info(one.desc.format).bytes_per_texel;
  BitDifference result;
  double largest = -1;
  for (size_t texel = 0; texel * texel_bytes < one.texels.size(); ++texel) {
    if (std::memcmp(&one.texels[texel * texel_bytes], &other.texels[texel * texel_bytes], texel_bytes) == 0) continue;
    ++result.texels;
    const auto x = static_cast<uint32_t>(texel % extent.width);
    const auto y = static_cast<uint32_t>(texel / extent.width % extent.height);
    const auto z = static_cast<uint32_t>(texel / extent.width / extent.height);
    for (uint32_t channel = 0; channel < format_info(one.desc.format).channels; ++channel) {
      const double a = one.at(x, y, z, channel);
      const double b = other.at(x, y, z, channel);
      if (distance(a, b) <= largest) continue;
      largest = distance(a, b);
      result.place = {x, y, z};
      result.channel = channel;
      result.one = a;
      result.other = b;
    }
  }
  return result;
}

}  // namespace lightloom::image
