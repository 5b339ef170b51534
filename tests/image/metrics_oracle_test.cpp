#include <gtest/gtest.h>

#include <cmath>

#include "framework/image/metrics.hpp"
#include "tests/image/flip_oracle.hpp"
#include "tests/image/metric_images.hpp"

namespace lightloom::image {
namespace {

oracle::Picture picture_of(const HostImage& image) {
  oracle::Picture picture{int(image.desc.extent.width), int(image.desc.extent.height), {}};
  for (uint32_t y = 0; y < image.desc.extent.height; ++y)
    for (uint32_t x = 0; x < image.desc.extent.width; ++x)
      picture.pixels.push_back({image.at(x, y, 0, 0), image.at(x, y, 0, 1), image.at(x, y, 0, 2)});
  return picture;
}

void expect_map(const HostImage& map, const std::vector<double>& expected) {
  double worst = 0, difference = 0, mean = 0;
  for (size_t i = 0; i < expected.size(); ++i) {
    const uint32_t width = map.desc.extent.width;
    const double value = map.at(uint32_t(i) % width, uint32_t(i) / width, 0, 0);
    worst = std::max(worst, std::abs(value - expected[i]));
    difference += (value - expected[i]) / double(expected.size());
    mean += expected[i] / double(expected.size());
  }
  EXPECT_LT(worst, 1e-4);
  EXPECT_LT(std::abs(difference), 1e-5);
  EXPECT_GT(mean, 0.02) << "the pictures differ too little for a test";
}

TEST(FlipOracle, display_values_at_several_viewing_distances) {
  const HostImage reference = test_picture(26, 19, 1, 0, 1);
  const HostImage test = test_picture(26, 19, 1, 0.3, 2);
  for (const double ppd : {3.0, 20.0, 40.0, 67.0206}) {
    MetricOptions options;
    options.flip = FlipKind::ldr;
    options.pixels_per_degree = ppd;
    expect_map(flip_map(reference, test, options), oracle::flip_display(picture_of(reference), picture_of(test), ppd));
  }
}

TEST(FlipOracle, radiance) {
  const HostImage reference = test_picture(18, 14, 40, 0, 3);
  const HostImage test = test_picture(18, 14, 40, 0.3, 4);
  MetricOptions options;
  options.pixels_per_degree = 25;
  expect_map(flip_map(reference, test, options),
             oracle::flip_radiance(picture_of(reference), picture_of(test), options.pixels_per_degree));
}

/// The definition, window by window: weighted means, then weighted squares of what differs from them.
double ssim_by_definition(const HostImage& reference, const HostImage& test) {
  const auto grey = [](const HostImage& image, uint32_t x, uint32_t y) {
    return 0.2126 * image.at(x, y, 0, 0) + 0.7152 * image.at(x, y, 0, 1) + 0.0722 * image.at(x, y, 0, 2);
  };
  const auto weight = [](int dx, int dy) { return std::exp(-(dx * dx + dy * dy) / (2 * 1.5 * 1.5)); };
  double total = 0;
  int windows = 0;
  for (int cy = 5; cy + 5 < int(reference.desc.extent.height); ++cy)
    for (int cx = 5; cx + 5 < int(reference.desc.extent.width); ++cx) {
      const auto average = [&](const auto& of_pixel) {
        double sum = 0, weights = 0;
        for (int dy = -5; dy <= 5; ++dy)
          for (int dx = -5; dx <= 5; ++dx) {
            const auto x = uint32_t(cx + dx), y = uint32_t(cy + dy);
            sum += weight(dx, dy) * of_pixel(grey(reference, x, y), grey(test, x, y));
            weights += weight(dx, dy);
          }
        return sum / weights;
      };
      const double mr = average([](double r, double) { return r; });
      const double mt = average([](double, double t) { return t; });
      const double vr = average([&](double r, double) { return (r - mr) * (r - mr); });
      const double vt = average([&](double, double t) { return (t - mt) * (t - mt); });
      const double covariance = average([&](double r, double t) { return (r - mr) * (t - mt); });
      total += (2 * mr * mt + 1e-4) * (2 * covariance + 9e-4) / ((mr * mr + mt * mt + 1e-4) * (vr + vt + 9e-4));
      ++windows;
    }
  return total / windows;
}

TEST(SsimOracle, by_definition) {
  MetricOptions options;
  options.with_flip = false;
  for (const double noise : {0.02, 0.1, 0.5}) {
    const HostImage reference = test_picture(31, 23, 1, 0, 1);
    const HostImage test = test_picture(31, 23, 1, noise, 2);
    EXPECT_NEAR(compare(reference, test, options).ssim, ssim_by_definition(reference, test), 1e-10);
  }
}

}  // namespace
}  // namespace lightloom::image
