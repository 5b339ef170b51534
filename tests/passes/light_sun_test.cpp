// The sun: where shadows end, and how soft the shadows of its disc are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/passes/light_scenes.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr uint32_t kSize = 64;
constexpr int kResolution = 66;      // over 4 m
constexpr double kVoxel = 4.0 / 64;  // [m]
// Of the blocker over the floor [m]: neither lies on a boundary between voxels.
constexpr double kHeight = 1 + 0.5 * kVoxel;

class LightSun : public DeviceTest {};

/// A floor under a sheet over the half with x > 0, seen from beneath the sheet.
scene::Scene half_covered(const glm::vec3& towards_sun, float angular_radius) {
  scene::Material black = lambertian(glm::vec3(0));
  black.double_sided = true;
  // Its edge lies where voxels begin: what is measured is the tracer, not how much voxels add to a surface.
  const auto edge = static_cast<float>(0.01 * kVoxel);
  const QuadSpec sheet{{edge, static_cast<float>(kHeight), 2}, {2 - edge, 0, 0}, {0, 0, -4}, 1};
  scene::Scene scene = make_quad_scene({square_floor(2), sheet}, {lambertian(glm::vec3(1)), black},
                                       look_at({0, 0.8f, 1.9f}, {0, 0, 0}, 1.2f));
  scene.sun = scene::Sun{-glm::normalize(towards_sun), glm::vec3(static_cast<float>(kPi)), angular_radius};
  scene.features.sun = true;
  return scene;
}

/// Part of the light that arrives on the floor, averaged over all pixels in bins of x from -1.5 to 1.5 m.
std::vector<SampleMean> profile(const std::vector<Images>& frames, double full, size_t bins) {
  std::vector<SampleMean> result(bins);
  for (const Images& images : frames)
    for (uint32_t y = 0; y < kSize; ++y)
      for (uint32_t x = 0; x < kSize; ++x) {
        const glm::dvec3 p = surface_position(images, x, y);
        if (images.at("radiance").at(x, y, 0, 3) == 0 || std::abs(p.y) > 1e-3 || std::abs(p.x) >= 1.5) continue;
        result[static_cast<size_t>((p.x + 1.5) / 3 * static_cast<double>(bins))].add(
            images.at("radiance").at(x, y, 0, 0) / full);
      }
  return result;
}

TEST_F(LightSun, ShadowsEndWithinAVoxelOfWhereTheyShould) {
  for (const float slope : {-0.5f, 0.0f, 0.5f}) {
    const glm::vec3 towards_sun = glm::normalize(glm::vec3(slope, 1, 0));
    const std::vector<Images> frames =
        trace_frames(half_covered(towards_sun, 0), {R"("paths": 1, "bounces": 0)", kSize, kResolution});
    const double edge = -static_cast<double>(slope) * kHeight;
    int lit = 0, dark = 0;
    for (uint32_t y = 0; y < kSize; ++y)
      for (uint32_t x = 0; x < kSize; ++x) {
        const glm::dvec3 p = surface_position(frames.front(), x, y);
        // Beyond the sheet's far edge the sun shines in again.
        const bool on_floor = std::abs(p.y) < 1e-3 && std::abs(p.z) < 1.9 && p.x < 2 + edge - 2 * kVoxel;
        if (frames.front().at("radiance").at(x, y, 0, 3) == 0 || !on_floor) continue;
        if (std::abs(p.x - edge) <= kVoxel) continue;
        const double expected = p.x < edge ? static_cast<double>(towards_sun.y) : 0;
        ASSERT_NEAR(frames.front().at("radiance").at(x, y, 0, 0), expected, 1e-3) << p.x << " " << slope;
        ++(p.x < edge ? lit : dark);
      }
    EXPECT_GT(lit, 200) << slope;
    EXPECT_GT(dark, 200) << slope;
  }
}

/// Part of a disc of radius 1 on one side of a line at distance t from its centre.
double disc_part(double t) {
  t = std::clamp(t, -1.0, 1.0);
  return 0.5 - (std::asin(t) + t * std::sqrt(1 - t * t)) / kPi;
}

TEST_F(LightSun, PenumbraIsAsWideAsTheDisc) {
  constexpr double kRadius = 0.3;  // [radians]: half width 0.31 m, five voxels
  const std::vector<Images> frames = trace_frames(half_covered({0, 1, 0}, static_cast<float>(kRadius)),
                                                  {R"("paths": 16, "bounces": 0)", kSize, kResolution, 4});
  constexpr size_t kBins = 48;  // one voxel wide
  const std::vector<SampleMean> light = profile(frames, 1, kBins);
  const double half_width = kHeight * std::tan(kRadius);
  double area = 0, exact_area = 0, spread = 0, exact_spread = 0;
  for (size_t bin = 0; bin < kBins; ++bin) {
    ASSERT_GT(light[bin].count(), 20) << bin;
    const double x = -1.5 + 3 * (static_cast<double>(bin) + 0.5) / kBins;
    // Nowhere lighter than a voxel further into the light, nor darker than one further into the shadow.
    const double tolerance = 4 * light[bin].error() + 0.01;
    EXPECT_LE(light[bin].mean(), disc_part((x - kVoxel) / half_width) + tolerance) << x;
    EXPECT_GE(light[bin].mean(), disc_part((x + kVoxel) / half_width) - tolerance) << x;
    area += light[bin].mean();
    exact_area += disc_part(x / half_width);
    // Light in the shadow and shadow in the light: in proportion to the width of the penumbra.
    spread += x > 0 ? light[bin].mean() : 1 - light[bin].mean();
    exact_spread += x > 0 ? disc_part(x / half_width) : 1 - disc_part(x / half_width);
  }
  EXPECT_NEAR(area, exact_area, 1) << "edge, in voxels";
  EXPECT_NEAR(spread / exact_spread, 1, 0.15);
}

TEST_F(LightSun, DiscGivesTheIrradianceOfThePoint) {
  // Perpendicular irradiance is what scenes give, whatever the disc's size.
  const glm::vec3 towards_sun = glm::normalize(glm::vec3(0.5f, 1, 0.3f));
  for (const float radius : {0.0f, 0.004653f, 0.3f}) {
    scene::Scene scene =
        make_quad_scene({square_floor(2)}, {lambertian(glm::vec3(0.5f))}, orthographic({0, 3, 0}, {0, 0, 0}, 1));
    scene.sun = scene::Sun{-towards_sun, glm::vec3(2, 3, 5), radius};
    scene.features.sun = true;
    const std::vector<Images> frames = trace_frames(scene, {.params = R"("paths": 16, "bounces": 0)", .frames = 2});
    for (uint32_t channel = 0; channel < 3; ++channel) {
      SampleMean estimate;
      for (const Images& images : frames) add_pixels(estimate, images, channel, 0, 32);
      const double exact = static_cast<double>(scene.sun->irradiance[static_cast<int>(channel)] * towards_sun.y) / kPi;
      EXPECT_NEAR(estimate.mean(), exact, 4 * estimate.error() + 1e-5 * exact) << radius;
    }
  }
}

}  // namespace
}  // namespace lightloom::test
