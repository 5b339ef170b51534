// Point and spot lights by the formulas of KHR_lights_punctual.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/passes/light_scenes.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

constexpr double kPi = 3.141592653589793;

class LightPunctual : public DeviceTest {};

scene::Scene lit_floor(const std::vector<scene::PunctualLight>& lights) {
  scene::Scene scene =
      make_quad_scene({square_floor(2)}, {lambertian(glm::vec3(0.5f))}, orthographic({0, 4, 0}, {0, 0, 0}, 1.6f));
  scene.punctual = lights;
  scene.features.punctual = true;
  return scene;
}

/// Irradiance over pi on a floor that faces up, times the angular falloff.
double unshadowed(const scene::PunctualLight& light, const glm::dvec3& p, double falloff) {
  const glm::dvec3 path = glm::dvec3(light.position) - p;
  const double d2 = glm::dot(path, path);
  double window = 1;
  if (light.range > 0) window = std::clamp(1 - std::pow(std::sqrt(d2) / static_cast<double>(light.range), 4), 0.0, 1.0);
  return static_cast<double>(light.intensity.g) * falloff * window * path.y / std::sqrt(d2) / d2 / kPi;
}

TEST_F(LightPunctual, RangeFadesAPointLightToNothing) {
  scene::PunctualLight lamp;
  lamp.intensity = glm::vec3(7);
  lamp.position = {-0.3f, 0.9f, 0.2f};
  lamp.range = 1.6f;
  const std::vector<Images> frames = trace_frames(lit_floor({lamp}), {.params = R"("paths": 1, "bounces": 0)"});
  int beyond = 0;
  for (uint32_t y = 0; y < 32; ++y)
    for (uint32_t x = 0; x < 32; ++x) {
      const double expected = unshadowed(lamp, surface_position(frames.front(), x, y), 1);
      ASSERT_NEAR(frames.front().at("radiance").at(x, y, 0, 1), expected, 1e-4 + 1e-3 * expected) << x << " " << y;
      beyond += expected == 0 ? 1 : 0;
    }
  EXPECT_GT(beyond, 50);
}

TEST_F(LightPunctual, SpotFadesFromTheInnerToTheOuterCone) {
  scene::PunctualLight lamp;
  lamp.type = scene::PunctualType::spot;
  lamp.intensity = glm::vec3(7);
  lamp.position = {0.8f, 1.2f, -0.5f};
  lamp.direction = glm::normalize(glm::vec3(-0.6f, -1, 0.4f));
  lamp.inner_cone = 0.2f;
  lamp.outer_cone = 0.7f;
  const std::vector<Images> frames = trace_frames(lit_floor({lamp}), {.params = R"("paths": 1, "bounces": 0)"});
  int between = 0;
  for (uint32_t y = 0; y < 32; ++y)
    for (uint32_t x = 0; x < 32; ++x) {
      const glm::dvec3 p = surface_position(frames.front(), x, y);
      const double cosine = glm::dot(glm::normalize(p - glm::dvec3(lamp.position)), glm::dvec3(lamp.direction));
      const double inner = std::cos(0.2), outer = std::cos(0.7);
      const double t = std::clamp((cosine - outer) / (inner - outer), 0.0, 1.0);
      const double expected = unshadowed(lamp, p, t * t);
      ASSERT_NEAR(frames.front().at("radiance").at(x, y, 0, 1), expected, 1e-4 + 1e-3 * expected) << x << " " << y;
      between += t > 0.1 && t < 0.9 ? 1 : 0;
    }
  EXPECT_GT(between, 50);
}

TEST_F(LightPunctual, LightsAddUp) {
  std::vector<scene::PunctualLight> lamps(3);
  lamps[0].position = {0.5f, 1, 0.5f};
  lamps[0].intensity = glm::vec3(4);
  lamps[1].position = {-1, 1.5f, 0};
  lamps[1].intensity = glm::vec3(9);
  lamps[2].type = scene::PunctualType::directional;
  lamps[2].direction = glm::normalize(glm::vec3(1, -1, 0));
  lamps[2].intensity = glm::vec3(2);
  const std::vector<Images> frames =
      trace_frames(lit_floor(lamps), {.params = R"("paths": 4, "bounces": 0)", .frames = 16});
  double exact = 0;
  for (uint32_t y = 0; y < 32; ++y)
    for (uint32_t x = 0; x < 32; ++x) {
      const glm::dvec3 p = surface_position(frames.front(), x, y);
      exact += (unshadowed(lamps[0], p, 1) + unshadowed(lamps[1], p, 1) + 2 * std::sqrt(0.5) / kPi) / (32 * 32);
    }
  const SampleMean estimate = frame_estimate(frames, 1);
  EXPECT_NEAR(estimate.mean(), exact, 3.5 * estimate.error());
  EXPECT_LT(estimate.error(), 0.01 * exact);
}

}  // namespace
}  // namespace lightloom::test
