// Light among triangles that is known in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "tests/passes/estimator_support.hpp"
#include "tests/passes/light_scenes.hpp"
#include "tests/ray_query/ray_query_support.hpp"

namespace lightloom::test {
namespace {

constexpr double kPi = 3.141592653589793;

class RayQueryClosedForm : public RayQueryTest {};

/// A sealed box whose walls all emit 2 and reflect `albedo`, seen from within.
scene::Scene emissive_box(float albedo, const glm::vec3& low, const glm::vec3& high) {
  scene::Material wall = lambertian(glm::vec3(albedo));
  wall.emission = glm::vec3(2);
  const glm::vec3 center = 0.5f * (low + high);
  return make_quad_scene(room_walls(low, high, 0), {wall}, look_at(center, center + glm::vec3(0.3f, -0.2f, 1), 1.2f));
}

TEST_F(RayQueryClosedForm, EmissiveBoxSumsTheSeriesOfItsBounces) {
  const std::vector<int> bounces = {0, 1, 2, 5};
  for (const float albedo : {0.5f, 0.8f}) {
    const std::vector<Images> frames =
        trace_rays(emissive_box(albedo, glm::vec3(-1), glm::vec3(1)),
                   {.params = R"("paths": 8)", .bounces = bounces, .size = 16, .frames = 8});
    for (size_t i = 0; i < bounces.size(); ++i) {
      const double rho = static_cast<double>(albedo);
      const double expected = 2 * (1 - std::pow(rho, bounces[i] + 1)) / (1 - rho);
      const Estimate whole = image_estimate(frames, "radiance" + std::to_string(i), 0).whole;
      EXPECT_LT(std::abs(whole.mean - expected), 3.5 * whole.error + 1e-5 * expected)
          << albedo << " " << bounces[i] << ": " << whole.mean << " +- " << whole.error << ", not " << expected;
      EXPECT_LT(whole.error, 0.02 * expected);
    }
  }
}

TEST_F(RayQueryClosedForm, NothingGetsLostAtAnyScaleOrPlace) {
  // Rays that slipped through the walls or met the wall that they leave would lose or gain light: each ray must find
  // the emission of the far wall exactly, whatever the digits of its coordinates.
  const std::vector<std::pair<glm::vec3, glm::vec3>> boxes = {{glm::vec3(-1e-4f), glm::vec3(1e-4f)},
                                                              {glm::vec3(-1e4f), glm::vec3(1e4f)},
                                                              {glm::vec3(999, -501, 300), glm::vec3(1001, -499, 302)}};
  for (const auto& [low, high] : boxes) {
    const Images images = trace_rays(emissive_box(0.5f, low, high),
                                     {.params = R"("paths": 16, "strategy": "bsdf")", .bounces = {0}, .size = 16})
                              .front();
    const image::HostImage& radiance = images.at("radiance");
    for (uint32_t y = 0; y < 16; ++y)
      for (uint32_t x = 0; x < 16; ++x) {
        if (radiance.at(x, y, 0, 3) == 0) continue;
        ASSERT_NEAR(radiance.at(x, y, 0, 0), 2, 2e-5) << high.x << " at " << x << " " << y;
      }
  }
}

/// From one rectangle to an equal one opposite, x by y at distance 1 (Howell's catalogue, C-11).
double parallel_rectangles(double x, double y) {
  const double a = 1 + x * x, b = 1 + y * y;
  return 2 / (kPi * x * y) *
         (std::log(std::sqrt(a * b / (a + b - 1))) + x * std::sqrt(b) * std::atan(x / std::sqrt(b)) +
          y * std::sqrt(a) * std::atan(y / std::sqrt(a)) - x * std::atan(x) - y * std::atan(y));
}

/// From a rectangle to one upright on the edge that they share, all lengths 1 (C-14).
constexpr double kUprightSquares = 0.200043776075403;

/// A floor of albedo 0.5 of which the unit square around the origin fills the image, and a lamp; the camera is between.
scene::Scene under(const QuadSpec& lamp, bool two_sided = false) {
  return make_quad_scene({square_floor(1), lamp},
                         {lambertian(glm::vec3(0.5f)), lamp_material(glm::vec3(5, 10, 20), two_sided)},
                         look_at({0, 0.5f, 0}, {0, 0, 0}, static_cast<float>(kPi / 2), {0, 0, -1}));
}

TEST_F(RayQueryClosedForm, RectanglesByTheirFormFactors) {
  const QuadSpec opposite{{-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1}, 1};
  const QuadSpec upright{{-0.5f, 0, 0.5f}, {0, 0, -1}, {0, 1, 0}, 1};
  const RaySettings settings{.params = R"("paths": 16)", .bounces = {0}, .frames = 12};
  const std::vector<Images> parallel = trace_rays(under(opposite), settings);
  for (const uint32_t channel : {0u, 1u, 2u}) {
    const SampleMean light = frame_estimate(parallel, channel);
    const double exact = 5 * std::pow(2.0, channel) * parallel_rectangles(1, 1);
    // Averaging over 32 x 32 pixels is a midpoint rule, good to a few parts in ten thousand.
    EXPECT_NEAR(light.mean(), exact, 3.5 * light.error() + 5e-4 * exact);
    EXPECT_LT(light.error(), 4e-3 * exact);
  }
  for (const bool two_sided : {false, true}) {
    const SampleMean light = frame_estimate(trace_rays(under(upright, two_sided), settings), 1);
    // At the edge the light changes within a pixel.
    EXPECT_NEAR(light.mean(), 10 * kUprightSquares, 3.5 * light.error() + 0.01 * 10 * kUprightSquares) << two_sided;
  }
}

TEST_F(RayQueryClosedForm, NothingFromTheBackOfAOneSidedLamp) {
  const QuadSpec turned{{-0.5f, 1, 0.5f}, {1, 0, 0}, {0, 0, -1}, 1};  // faces up
  const std::vector<Images> frames = trace_rays(under(turned), {.params = R"("paths": 16)", .frames = 2});
  EXPECT_EQ(frame_estimate(frames, 1).mean(), 0);
}

/// A floor and an upright wall that throws shadows, under all lights without area.
scene::Scene outdoors() {
  scene::Material wall = lambertian(glm::vec3(0.5f));
  wall.double_sided = true;
  scene::Scene scene = make_quad_scene({square_floor(2), {{-0.3f, 0, 0.8f}, {0, 0, -1.6f}, {0, 1, 0}, 1}},
                                       {lambertian(glm::vec3(0.5f)), wall}, orthographic({0, 4, 0}, {0, 0, 0}, 1.6f));
  scene.sun = scene::Sun{glm::normalize(glm::vec3(1, -2, 0)), glm::vec3(3), 0};
  scene::PunctualLight bulb;
  bulb.intensity = glm::vec3(7);
  bulb.position = {-0.9f, 0.7f, 0.217f};
  scene.punctual = {bulb};
  scene.features.sun = scene.features.punctual = true;
  return scene;
}

/// Does the segment from a point of the floor to `target` pass the wall of `outdoors`?
bool behind_wall(const glm::dvec3& p, const glm::dvec3& target) {
  const double t = (-0.3 - p.x) / (target.x - p.x);
  if (!(t > 0 && t < 1)) return false;
  const glm::dvec3 at = p + t * (target - p);
  return at.y < 1 && std::abs(at.z) < 0.8;
}

TEST_F(RayQueryClosedForm, SunAndBulbWithTheShadowsOfAWall) {
  const Images images = trace_rays(outdoors(), {.params = R"("paths": 1, "strategy": "nee")", .bounces = {0}}).front();
  const glm::dvec3 sun = glm::normalize(glm::dvec3(-1, 2, 0)), bulb(-0.9, 0.7, 0.217);
  int shaded = 0, lit = 0;
  for (uint32_t y = 0; y < 32; ++y)
    for (uint32_t x = 0; x < 32; ++x) {
      const glm::dvec3 p = surface_position(images, x, y);
      if (std::abs(p.x + 0.3) < 0.06) continue;  // the wall itself, and where it stands
      const glm::dvec3 path = bulb - p;
      const double d2 = glm::dot(path, path);
      double expected = behind_wall(p, p + 9.0 * sun) ? 0 : 3 * sun.y / kPi;
      if (!behind_wall(p, bulb)) expected += 7 * path.y / std::sqrt(d2) / d2 / kPi;
      ASSERT_NEAR(images.at("radiance").at(x, y, 0, 1), expected, 1e-3 * expected) << x << " " << y;
      (expected < 0.5 ? shaded : lit) += 1;
    }
  EXPECT_GT(shaded, 20);
  EXPECT_GT(lit, 500);
}

TEST_F(RayQueryClosedForm, FloorUnderAConstantSkySeesItAll) {
  scene::Scene scene =
      make_quad_scene({square_floor(2)}, {lambertian(glm::vec3(0.5f))}, orthographic({0, 4, 0}, {0, 0, 0}, 1.6f));
  scene.environment.radiance = glm::vec3(1, 2, 3);
  scene.features.environment = true;
  const Images images = trace_rays(scene, {.params = R"("paths": 1)"}).front();
  for (uint32_t k = 0; k < 32; ++k)
    for (uint32_t channel = 0; channel < 3; ++channel)
      ASSERT_NEAR(images.at("radiance").at(k, (k * 7) % 32, 0, channel), channel + 1.0, 1e-4);
}

}  // namespace
}  // namespace lightloom::test
