#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/passes/light_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

constexpr uint32_t kSize = 64;

class Tonemap : public DeviceTest {};

/// The pattern "ramp": red x/16, green y/16, blue 2.
Images tonemap(const std::string& params, const std::string& pattern = "ramp") {
  const scene::Scene wall = make_quad_scene({{{-3, -3, 0}, {6, 0, 0}, {0, 6, 0}}}, {lambertian(glm::vec3(0.5f))},
                                            look_at({0, 0, 3}, {0, 0, 0}, 0.8f));
  const std::string passes = R"("gather": { "type": "gather" },
    "pattern": { "type": "pattern", "in": { "surface": "gather.surface" }, "params": { "pattern": ")" +
                             pattern + R"(" } },
    "tonemap": { "type": "tonemap", "in": { "radiance": "pattern.radiance" }, "params": { )" +
                             params + " } }";
  GraphRunOptions options;
  options.extra_types = {make_pattern()};
  return run_graph(graph_text(kSize, kSize, kSize, kSize, passes, R"("image": "tonemap.image")"), wall, options)
      .front();
}

double srgb(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

void expect_curve(const Images& images, double gain, const std::function<double(double)>& curve) {
  const image::HostImage& image = images.at("image");
  const double step = 1.01 / 255;
  for (uint32_t y = 0; y < kSize; y += 3)
    for (uint32_t x = 0; x < kSize; x += 3) {
      ASSERT_NEAR(image.at(x, y, 0, 0), srgb(curve(gain * x / 16.0)), step) << x;
      ASSERT_NEAR(image.at(x, y, 0, 1), srgb(curve(gain * y / 16.0)), step) << y;
      ASSERT_NEAR(image.at(x, y, 0, 2), srgb(curve(gain * 2)), step);
      ASSERT_EQ(image.at(x, y, 0, 3), 1);
    }
}

TEST_F(Tonemap, LinearEncodesAndClips) {
  expect_curve(tonemap(R"("curve": "linear")"), 1, [](double x) { return x; });
}

TEST_F(Tonemap, ExposureCountsInStops) {
  expect_curve(tonemap(R"("curve": "linear", "exposure": -2)"), 0.25, [](double x) { return x; });
}

TEST_F(Tonemap, ReinhardCompresses) {
  expect_curve(tonemap(R"("curve": "reinhard", "exposure": 1)"), 2, [](double x) { return x / (1 + x); });
}

TEST_F(Tonemap, FilmicFollowsTheRationalFit) {
  expect_curve(tonemap(R"("curve": "filmic")"), 1,
               [](double x) { return (2.51 * x * x + 0.03 * x) / (2.43 * x * x + 0.59 * x + 0.14); });
}

TEST_F(Tonemap, WhatIsNoNumberBecomesBlack) {
  const Images images = tonemap(R"("curve": "linear")", "spoilt");
  EXPECT_EQ(images.at("image").at(kSize / 2, kSize / 2, 0, 0), 0);
  EXPECT_EQ(images.at("image").at(0, 0, 0, 0), 1);
}

}  // namespace
}  // namespace lightloom::test
