#include <gtest/gtest.h>

#include <cmath>

#include "framework/image/metrics.hpp"
#include "tests/image/metric_images.hpp"

// Vectors that other programs computed for pictures made by formulas: FLIP by its authors' own program (v1.6, 67.0206
// pixels per degree), the others by a few lines of double arithmetic. The pair of pictures whose mean FLIP its authors
// publish (0.159691 for display values, 0.283478 for radiance) is not at hand here.
namespace lightloom::image {
namespace {

constexpr uint32_t kSide = 64;
constexpr double kFirefly = 1e4;

bool is_middle(uint32_t x, uint32_t y) {
  return x == 32 && y == 32;
}
HostImage grey(double value) {
  return grey_image(kSide, kSide, [value](uint32_t, uint32_t) { return value; });
}
HostImage checker() {
  return grey_image(kSide, kSide, [](uint32_t x, uint32_t y) { return (x + y) % 2; });
}
HostImage black_with_one_pixel() {
  return grey_image(kSide, kSide, [](uint32_t x, uint32_t y) { return is_middle(x, y) ? 1.0 : 0.0; });
}
HostImage ramp(double exponent) {
  return grey_image(kSide, kSide, [exponent](uint32_t x, uint32_t) { return std::pow(x / 63.0, exponent); });
}
HostImage hdr_ramp(bool firefly) {
  return grey_image(kSide, kSide, [firefly](uint32_t x, uint32_t y) {
    return firefly && is_middle(x, y) ? kFirefly : std::exp2(x / 8.0 - 4);
  });
}

struct FlipRange {
  double mean = 0, least = 1, most = 0;
};
FlipRange flip_of(const HostImage& reference, const HostImage& test, FlipKind kind) {
  MetricOptions options;
  options.flip = kind;
  const HostImage map = flip_map(reference, test, options);
  FlipRange range;
  for (uint32_t y = 0; y < map.desc.extent.height; ++y)
    for (uint32_t x = 0; x < map.desc.extent.width; ++x) {
      const double value = map.at(x, y, 0, 0);
      range.mean += value / (map.desc.extent.width * map.desc.extent.height);
      range.least = std::min(range.least, value);
      range.most = std::max(range.most, value);
    }
  EXPECT_NEAR(compare(reference, test, options).flip, range.mean, 1e-12);
  return range;
}
void expect_flip(const FlipRange& range, double mean, double least, double most) {
  EXPECT_NEAR(range.mean, mean, 5e-5);  // rounding makes features of noise where a picture is constant: theirs
  EXPECT_NEAR(range.least, least, 1e-4);
  EXPECT_NEAR(range.most, most, 1e-4);
}

TEST(FlipVectors, display_values) {
  const FlipKind kind = FlipKind::ldr;
  expect_flip(flip_of(grey(0), grey(1), kind), 0.967388, 0.967388, 0.967388);
  expect_flip(flip_of(checker(), checker(), kind), 0, 0, 0);
  expect_flip(flip_of(grey(0.5), grey(0.6), kind), 0.196255, 0.196255, 0.196255);
  expect_flip(flip_of(constant_image(kSide, kSide, {1, 0, 0}), constant_image(kSide, kSide, {0, 1, 0}), kind), 0.986665,
              0.986665, 0.986665);
  expect_flip(flip_of(checker(), grey(0.5), kind), 0.004204, 0.001040, 0.515740);
  expect_flip(flip_of(grey(0), black_with_one_pixel(), kind), 0.003493, 0, 0.864906);
  expect_flip(flip_of(constant_image(1, 1, {0.25, 0.25, 0.25}), constant_image(1, 1, {0.75, 0.75, 0.75}), kind),
              0.655532, 0.655532, 0.655532);
}

TEST(FlipVectors, radiance) {
  const FlipKind kind = FlipKind::hdr;
  expect_flip(flip_of(hdr_ramp(false), hdr_ramp(true), kind), 0.001374, 0, 0.472778);
  expect_flip(flip_of(grey(1), grey(1.1), kind), 0.043999, 0.043999, 0.043999);
}

struct ClassicRow {
  const char* name;
  HostImage reference, test;
  double mse, psnr, relmse, mape, smape, ssim;
};

TEST(MetricVectors, sums_and_ssim) {
  const std::array<ClassicRow, 5> rows = {{
      {"ramp", ramp(1), ramp(2), 0.032812498, 14.839607, 0.22034525, 0.45435621, 0.74495403, 0.68461686},
      {"grey", grey(0.5), grey(0.6), 0.01, 20, 0.038461538, 0.19607843, 0.18181818, 0.98360924},
      {"checker", checker(), grey(0.5), 0.25, 6.020600, 12.623762, 25.247525, 1.3333333, 0.00358709},
      {"one pixel", grey(0), black_with_one_pixel(), 0.00024414062, 36.123599, 0.024414062, 0.024414062, 0.00048828125,
       0.97840087},
      {"firefly", hdr_ramp(false), hdr_ramp(true), 24409.18, -43.875532, 24167.505, 2.4169922, 0.0004881836,
       0.95850536},
  }};
  MetricOptions options;
  options.with_flip = false;
  for (const ClassicRow& row : rows) {
    SCOPED_TRACE(row.name);
    const Metrics metrics = compare(row.reference, row.test, options);
    EXPECT_NEAR(metrics.mse / row.mse, 1, 1e-6);
    EXPECT_NEAR(metrics.rmse / std::sqrt(row.mse), 1, 1e-6);
    EXPECT_NEAR(metrics.psnr, row.psnr, 1e-5);
    EXPECT_NEAR(metrics.relmse / row.relmse, 1, 1e-6);
    EXPECT_NEAR(metrics.mape / row.mape, 1, 1e-6);
    EXPECT_NEAR(metrics.smape / row.smape, 1, 1e-6);
    EXPECT_NEAR(metrics.ssim, row.ssim, 1e-6);
    EXPECT_TRUE(std::isnan(metrics.flip));
  }
}

}  // namespace
}  // namespace lightloom::image
