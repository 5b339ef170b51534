#include "framework/stability/differences.hpp"

#include <algorithm>
#include <cmath>

#include "framework/image/bit_difference.hpp"

namespace lightloom::stability {
namespace {

template <typename Visit>
void for_each_texel(const image::HostImage& image, const Visit& visit) {
  const Extent3& extent = image.desc.extent;
  for (uint32_t z = 0; z < extent.depth; ++z)
    for (uint32_t y = 0; y < extent.height; ++y)
      for (uint32_t x = 0; x < extent.width; ++x) visit(x, y, z);
}

size_t texel_count(const image::HostImage& image) {
  const Extent3& extent = image.desc.extent;
  return size_t{extent.width} * extent.height * extent.depth;
}

uint32_t colors(const image::HostImage& image) {
  return std::min(format_info(image.desc.format).channels, 3u);
}

double mean_magnitude(const image::HostImage& image) {
  double sum = 0;
  for_each_texel(image, [&](uint32_t x, uint32_t y, uint32_t z) {
    for (uint32_t c = 0; c < colors(image); ++c) sum += std::abs(image.at(x, y, z, c));
  });
  return sum / static_cast<double>(texel_count(image) * colors(image));
}

/// Shows the relative difference of each texel; infinite where one of the two is not finite.
template <typename Visit>
void for_each_difference(const image::HostImage& reference, const image::HostImage& test, const Visit& visit) {
  const double mean = mean_magnitude(reference);
  for_each_texel(reference, [&](uint32_t x, uint32_t y, uint32_t z) {
    double largest = 0;
    for (uint32_t c = 0; c < colors(reference); ++c) {
      const double expected = reference.at(x, y, z, c), off = std::abs(test.at(x, y, z, c) - expected);
      if (off == 0) continue;
      const double relative = off / std::max(std::abs(expected), mean);
      largest = std::max(largest, std::isfinite(relative) ? relative : INFINITY);
    }
    visit(largest);
  });
}

}  // namespace

double differing_texels(const image::HostImage& a, const image::HostImage& b) {
  if (a.desc != b.desc) return static_cast<double>(texel_count(a));
  return static_cast<double>(image::bit_difference(a, b).texels);
}

double non_finite_texels(const image::HostImage& image) {
  double count = 0;
  for_each_texel(image, [&](uint32_t x, uint32_t y, uint32_t z) {
    bool finite = true;
    for (uint32_t c = 0; c < format_info(image.desc.format).channels; ++c)
      finite = finite && std::isfinite(image.at(x, y, z, c));
    count += finite ? 0 : 1;
  });
  return count;
}

double largest_relative_difference(const image::HostImage& reference, const image::HostImage& test) {
  double largest = 0;
  for_each_difference(reference, test, [&](double relative) { largest = std::max(largest, relative); });
  return largest;
}

double share_beyond(const image::HostImage& reference, const image::HostImage& test, double bound) {
  double beyond = 0;
  for_each_difference(reference, test, [&](double relative) { beyond += relative > bound ? 1 : 0; });
  return beyond / static_cast<double>(texel_count(reference));
}

double peak_signal_to_noise(const image::HostImage& reference, const image::HostImage& test) {
  double sum = 0;
  for_each_texel(reference, [&](uint32_t x, uint32_t y, uint32_t z) {
    for (uint32_t c = 0; c < colors(reference); ++c) {
      const double off = test.at(x, y, z, c) - reference.at(x, y, z, c);
      sum += off * off;
    }
  });
  if (sum == 0) return 999;
  const double peak = largest_value(reference);
  return 10 * std::log10(peak * peak * static_cast<double>(texel_count(reference) * colors(reference)) / sum);
}

Mean mean_of(const image::HostImage& image) {
  double sum = 0, squares = 0;
  for_each_texel(image, [&](uint32_t x, uint32_t y, uint32_t z) {
    double value = 0;
    for (uint32_t c = 0; c < colors(image); ++c) value += image.at(x, y, z, c) / colors(image);
    sum += value;
    squares += value * value;
  });
  const auto count = static_cast<double>(texel_count(image));
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(squares / count - mean * mean, 0.0) / count)};
}

double largest_value(const image::HostImage& image) {
  double largest = 0;
  for_each_texel(image, [&](uint32_t x, uint32_t y, uint32_t z) {
    for (uint32_t c = 0; c < colors(image); ++c) largest = std::max(largest, image.at(x, y, z, c));
  });
  return largest;
}

}  // namespace lightloom::stability
