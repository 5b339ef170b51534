#include <gtest/gtest.h>

#include <cmath>

#include "tests/passes/light_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

constexpr uint32_t kSize = 32;
constexpr double kPi = 3.141592653589793;

class VoxelPathTrace : public DeviceTest {
 protected:
  static Images trace(const scene::Scene& scene, const std::string& params, int resolution = 32, uint32_t seed = 1) {
    const std::string text = graph_text(kSize, kSize, kSize, kSize, trace_passes(resolution, params),
                                        R"("radiance": "trace.radiance", "position": "gather.surface.position")");
    GraphRunOptions options;
    options.seed = seed;
    return run_graph(text, scene, options).front();
  }
};

/// A floor of 4 x 4 m around the origin that faces up.
QuadSpec floor_quad(uint32_t material = 0) {
  return {{-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, material};
}

scene::Camera above_floor() {
  return look_at({0, 3, 0.01f}, {0, 0, 0}, 0.9f, {0, 0, -1});
}

glm::dvec3 position_at(const Images& images, uint32_t x, uint32_t y) {
  const image::HostImage& position = images.at("position");
  return {position.at(x, y, 0, 0), position.at(x, y, 0, 1), position.at(x, y, 0, 2)};
}

void expect_every_pixel(const Images& images, double value, double tolerance) {
  const image::HostImage& radiance = images.at("radiance");
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x) {
      ASSERT_EQ(radiance.at(x, y, 0, 3), 1) << x << " " << y;
      ASSERT_NEAR(radiance.at(x, y, 0, 1), value, tolerance) << x << " " << y;
    }
}

TEST_F(VoxelPathTrace, ConvexSurfaceUnderWhiteSkyReflectsItsAlbedo) {
  for (const float base : {1.0f, 0.2f}) {
    scene::Scene scene = make_quad_scene({floor_quad()}, {lambertian(glm::vec3(base))}, above_floor());
    scene.environment.radiance = glm::vec3(3);
    scene.features.environment = true;
    // Radiance is divided by the modulation colour, which for a Lambertian surface is its base colour.
    expect_every_pixel(trace(scene, R"("paths": 1)"), 3, 1e-3);
  }
}

TEST_F(VoxelPathTrace, MirrorReflectsTheSky) {
  scene::Material mirror = lambertian(glm::vec3(0.8f));
  mirror.metallic = 1;
  mirror.roughness = 0;
  scene::Scene scene = make_quad_scene({floor_quad()}, {mirror}, above_floor());
  scene.environment.radiance = glm::vec3(2);
  scene.features.environment = true;
  expect_every_pixel(trace(scene, R"("paths": 1)"), 2, 2e-3);
}

/// Over a convex floor every path marches one ray, which leaves the grid.
TEST_F(VoxelPathTrace, CountsTheRaysOfAllPathsAndChangesNothing) {
  scene::Scene scene = make_quad_scene({floor_quad()}, {lambertian(glm::vec3(0.5f))}, above_floor());
  scene.environment.radiance = glm::vec3(3);
  scene.features.environment = true;
  for (const uint32_t paths : {1U, 7U}) {
    const std::string params = R"("paths": )" + std::to_string(paths);
    const std::string text = graph_text(kSize, kSize, kSize, kSize, trace_passes(32, params),
                                        R"("radiance": "trace.radiance", "counts": "trace.counts")");
    GraphRunOptions options;
    options.seed = 1;
    const Images images = run_graph(text, scene, options).front();
    for (uint32_t y = 0; y < kSize; ++y)
      for (uint32_t x = 0; x < kSize; ++x) {
        ASSERT_EQ(images.at("counts").at(x, y, 0, 0), paths) << x << " " << y;
        ASSERT_GE(images.at("counts").at(x, y, 0, 1), paths) << x << " " << y;
      }
    EXPECT_EQ(images.at("radiance").texels, trace(scene, params).at("radiance").texels);
  }
  scene.environment.radiance = glm::vec3(0);
  scene.features.environment = false;
  const std::string dark = graph_text(kSize, kSize, kSize, kSize, trace_passes(32, R"("paths": 3, "bounces": 0)"),
                                      R"("counts": "trace.counts")");
  const Images images = run_graph(dark, scene).front();
  for (const std::byte byte : images.at("counts").texels) ASSERT_EQ(byte, std::byte{0});
}

TEST_F(VoxelPathTrace, BackgroundAndUnlitSurfacesStayBlack) {
  scene::Material unlit = lambertian(glm::vec3(1));
  unlit.unlit = true;
  scene::Scene scene = make_quad_scene({floor_quad()}, {unlit}, look_at({0, 3, 0.01f}, {0, 0, 0}, 2.2f, {0, 0, -1}));
  scene.environment.radiance = glm::vec3(2);
  scene.features.environment = true;
  const Images images = trace(scene, R"("paths": 1)");
  EXPECT_EQ(images.at("position").at(0, 0, 0, 3), 0) << "the corner should look past the floor";
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x)
      for (uint32_t channel = 0; channel < 4; ++channel)
        ASSERT_EQ(images.at("radiance").at(x, y, 0, channel), 0) << x << " " << y;
}

TEST_F(VoxelPathTrace, SunOnAPlaneFollowsTheCosineLaw) {
  scene::Scene scene = make_quad_scene({floor_quad()}, {lambertian(glm::vec3(0.5f))}, above_floor());
  const double angle = 60 * kPi / 180;
  scene.sun = scene::Sun{glm::vec3(std::sin(angle), -std::cos(angle), 0), glm::vec3(4, 8, 2), 0};
  scene.features.sun = true;
  expect_every_pixel(trace(scene, R"("paths": 1)"), 8 * 0.5 / kPi, 1e-3);
  scene.sun->angular_radius = 0.05f;
  expect_every_pixel(trace(scene, R"("paths": 64)"), 8 * 0.5 / kPi, 0.05);
}

TEST_F(VoxelPathTrace, BlockerCastsAShadow) {
  const QuadSpec blocker{{0, 1, 2}, {2, 0, 0}, {0, 0, -4}, 1};  // above the half with x > 0
  scene::Material both_sides = lambertian(glm::vec3(0));
  both_sides.double_sided = true;
  scene::Scene scene = make_quad_scene({floor_quad(), blocker}, {lambertian(glm::vec3(1)), both_sides},
                                       look_at({-1.5f, 0.6f, 0.01f}, {0.2f, 0, 0}, 0.8f));
  scene.sun = scene::Sun{glm::vec3(0, -1, 0), glm::vec3(static_cast<float>(kPi)), 0};
  scene.features.sun = true;
  const Images images = trace(scene, R"("paths": 1, "bounces": 0)", 64);
  int lit = 0, dark = 0;
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x) {
      const glm::dvec3 p = position_at(images, x, y);
      if (images.at("radiance").at(x, y, 0, 3) == 0 || std::abs(p.y) > 1e-3) continue;
      const double value = images.at("radiance").at(x, y, 0, 0);
      if (std::abs(p.x) <= 0.15) continue;
      ASSERT_NEAR(value, p.x < 0 ? 1 : 0, 1e-3) << p.x;
      ++(p.x < 0 ? lit : dark);
    }
  EXPECT_GT(lit, 50);
  EXPECT_GT(dark, 50);
}

TEST_F(VoxelPathTrace, PunctualLightFallsOffWithTheSquareOfTheDistance) {
  scene::Scene scene = make_quad_scene({floor_quad()}, {lambertian(glm::vec3(0.5f))}, above_floor());
  scene::PunctualLight lamp;
  lamp.intensity = glm::vec3(6);
  lamp.position = {0.4f, 1.2f, -0.3f};
  scene.punctual = {lamp};
  scene.features.punctual = true;
  const Images images = trace(scene, R"("paths": 1, "bounces": 0)");
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x) {
      const glm::dvec3 path = glm::dvec3(0.4, 1.2, -0.3) - position_at(images, x, y);
      const double d = glm::length(path);
      ASSERT_NEAR(images.at("radiance").at(x, y, 0, 2), 6 * (path.y / d) / (d * d) / kPi, 5e-3) << x << " " << y;
    }
}

TEST_F(VoxelPathTrace, SpotLightsOnlyItsCone) {
  scene::Scene scene = make_quad_scene({floor_quad()}, {lambertian(glm::vec3(0.5f))}, above_floor());
  scene::PunctualLight lamp;
  lamp.type = scene::PunctualType::spot;
  lamp.intensity = glm::vec3(6);
  lamp.position = {0, 1, 0};
  lamp.direction = {0, -1, 0};
  lamp.inner_cone = 0.2f;
  lamp.outer_cone = 0.4f;
  scene.punctual = {lamp};
  scene.features.punctual = true;
  const Images images = trace(scene, R"("paths": 1, "bounces": 0)");
  int inside = 0, outside = 0;
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x) {
      const glm::dvec3 path = glm::dvec3(0, 1, 0) - position_at(images, x, y);
      const double d = glm::length(path), angle = std::acos(path.y / d);
      const double value = images.at("radiance").at(x, y, 0, 0);
      if (angle > 0.19 && angle < 0.41) continue;
      ASSERT_NEAR(value, angle < 0.3 ? 6 * (path.y / d) / (d * d) / kPi : 0, 5e-3);
      ++(angle < 0.3 ? inside : outside);
    }
  EXPECT_GT(inside, 5);
  EXPECT_GT(outside, 100);
}

/// Form factor of a rectangle seen from a point with normal n, by Lambert's polygon formula.
double form_factor(const std::vector<glm::dvec3>& corners, const glm::dvec3& p, const glm::dvec3& n) {
  glm::dvec3 sum(0);
  for (size_t k = 0; k < corners.size(); ++k) {
    const glm::dvec3 a = glm::normalize(corners[k] - p), b = glm::normalize(corners[(k + 1) % corners.size()] - p);
    sum += std::acos(glm::dot(a, b)) * glm::normalize(glm::cross(a, b));
  }
  return std::abs(glm::dot(sum, n)) / (2 * kPi);
}

TEST_F(VoxelPathTrace, EmissiveQuadLightsAPlaneByItsFormFactor) {
  scene::Material lamp = lambertian(glm::vec3(0));
  lamp.emission = glm::vec3(5, 10, 20);
  const QuadSpec light{{-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1}, 1};  // faces down
  const scene::Scene scene = make_quad_scene({floor_quad(), light}, {lambertian(glm::vec3(0.5f)), lamp},
                                             look_at({-1.6f, 0.7f, 0.01f}, {0, 0, 0}, 0.8f));
  const Images images = trace(scene, R"("paths": 64, "bounces": 0)", 66);
  const std::vector<glm::dvec3> corners = {{-0.5, 1, -0.5}, {0.5, 1, -0.5}, {0.5, 1, 0.5}, {-0.5, 1, 0.5}};
  double measured = 0, exact = 0;
  int count = 0;
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x) {
      const glm::dvec3 p = position_at(images, x, y);
      if (images.at("position").at(x, y, 0, 3) <= 0 || std::abs(p.y) > 1e-3 || glm::length(p) > 1) continue;
      const double value = images.at("radiance").at(x, y, 0, 1);
      const double expected = 10 * form_factor(corners, p, {0, 1, 0});
      EXPECT_NEAR(value, expected, 0.35 * expected) << p.x << " " << p.z;
      measured += value;
      exact += expected;
      ++count;
    }
  EXPECT_GT(count, 200);
  // Rays meet the lamp as voxels, 17 across instead of 16: an eighth more area for the part of the light that MIS gives
  // to them.
  EXPECT_NEAR(measured / exact, 1, 0.08);
}

std::vector<QuadSpec> inward_box() {
  return {{{-1, -1, 1}, {2, 0, 0}, {0, 0, -2}}, {{-1, 1, -1}, {2, 0, 0}, {0, 0, 2}},
          {{-1, -1, -1}, {2, 0, 0}, {0, 2, 0}}, {{1, -1, 1}, {-2, 0, 0}, {0, 2, 0}},
          {{-1, -1, 1}, {0, 0, -2}, {0, 2, 0}}, {{1, -1, -1}, {0, 0, 2}, {0, 2, 0}}};
}

TEST_F(VoxelPathTrace, ClosedEmissiveBoxSumsTheSeriesOfItsBounces) {
  scene::Material wall = lambertian(glm::vec3(0.5f));
  wall.emission = glm::vec3(1);
  const scene::Scene scene = make_quad_scene(inward_box(), {wall}, look_at({0, 0, 0}, {0.3f, -0.2f, 1}, 1.2f));
  // Emission 1, albedo 0.5: light scattered 1 to bounces + 1 times, over the albedo.
  for (const int bounces : {0, 1, 3}) {
    const double expected = (1 - std::pow(0.5, bounces + 1)) / 0.5;
    const Images images = trace(scene, R"("paths": 16, "bounces": )" + std::to_string(bounces), 64);
    EXPECT_NEAR(mean_of(images.at("radiance"), 0, 0, 0, kSize, kSize), expected, 0.04 * expected) << bounces;
  }
}

TEST_F(VoxelPathTrace, NothingLeaksIntoAClosedDarkBox) {
  scene::Scene scene =
      make_quad_scene(inward_box(), {lambertian(glm::vec3(0.8f))}, look_at({0, 0, 0}, {0.3f, -0.5f, 1}, 1.4f));
  scene.environment.radiance = glm::vec3(100);
  scene.sun = scene::Sun{glm::vec3(0.3f, -0.9f, 0.2f), glm::vec3(100), 0};
  scene.features.environment = scene.features.sun = true;
  expect_every_pixel(trace(scene, R"("paths": 8)", 48), 0, 0);
}

TEST_F(VoxelPathTrace, SameSeedGivesTheSameBits) {
  scene::Material wall = lambertian(glm::vec3(0.5f));
  wall.emission = glm::vec3(1);
  const scene::Scene scene = make_quad_scene(inward_box(), {wall}, look_at({0, 0, 0}, {0.3f, -0.2f, 1}, 1.2f));
  const Images first = trace(scene, R"("paths": 2)"), again = trace(scene, R"("paths": 2)");
  EXPECT_EQ(first.at("radiance").texels, again.at("radiance").texels);
  EXPECT_NE(first.at("radiance").texels, trace(scene, R"("paths": 2)", 32, 2).at("radiance").texels);
}

TEST_F(VoxelPathTrace, CodeForUnusedFeaturesChangesNothing) {
  scene::Scene scene = make_quad_scene({floor_quad(), {{-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1}, 0}},
                                       {lambertian(glm::vec3(0.5f))}, look_at({-1.6f, 0.7f, 0.01f}, {0, 0, 0}, 0.8f));
  scene.sun = scene::Sun{glm::vec3(0.3f, -0.9f, 0.2f), glm::vec3(3), 0.01f};
  scene.features = {};
  scene.features.sun = true;
  const Images special = trace(scene, R"("paths": 4)");
  scene.features = {true, true, true, true, true, true, true, true, true, true, true, true};
  EXPECT_EQ(special.at("radiance").texels, trace(scene, R"("paths": 4)").at("radiance").texels);
}

}  // namespace
}  // namespace lightloom::test
