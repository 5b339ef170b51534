// What must not depend on how a scene is put: its scale of radiance, its direction, things that cannot be seen.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/passes/light_scenes.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

class LightSymmetry : public DeviceTest {};

/// A glossy floor and a wall under a sun, a sky, two punctual lights and a lamp.
scene::Scene everything(float brightness) {
  scene::Material floor;
  floor.base_color = glm::vec4(0.8f, 0.6f, 0.4f, 1);
  floor.metallic = 0.3f;
  floor.roughness = 0.6f;
  scene::Material wall = lambertian(glm::vec3(0.3f, 0.7f, 0.5f));
  wall.double_sided = true;
  scene::Material lamp = lambertian(glm::vec3(0.5f));
  lamp.emission = brightness * glm::vec3(3, 5, 8);
  const QuadSpec upright{{-0.4f, 0, 0.8f}, {0, 0, -1.4f}, {0, 1.1f, 0}, 1};
  const QuadSpec light{{0.5f, 1.4f, -1}, {0.8f, 0, 0}, {0, 0, 0.6f}, 2};
  scene::Scene scene = make_quad_scene({square_floor(2), upright, light}, {floor, wall, lamp},
                                       look_at({2.2f, 1.3f, 1.6f}, {0, 0.2f, 0}, 0.9f));
  scene.sun = scene::Sun{glm::normalize(glm::vec3(0.4f, -1, 0.3f)), brightness * glm::vec3(4), 0.1f};
  scene.environment.radiance = brightness * glm::vec3(0.2f, 0.3f, 0.5f);
  scene::PunctualLight point, spot;
  point.position = {1.2f, 0.8f, 0.9f};
  point.intensity = brightness * glm::vec3(2);
  spot.type = scene::PunctualType::spot;
  spot.position = {0, 1.8f, 1};
  spot.direction = glm::normalize(glm::vec3(0.1f, -1, -0.5f));
  spot.intensity = brightness * glm::vec3(4, 1, 1);
  scene.punctual = {point, spot};
  scene.features.sun = scene.features.environment = scene.features.punctual = true;
  return scene;
}

std::vector<float> radiance_of(const scene::Scene& scene) {
  const std::vector<Images> frames = trace_frames(scene, {.params = R"("paths": 2, "bounces": 2)", .resolution = 24});
  std::vector<float> values;
  const image::HostImage& radiance = frames.front().at("radiance");
  for (uint32_t y = 0; y < 32; ++y)
    for (uint32_t x = 0; x < 32; ++x)
      for (uint32_t channel = 0; channel < 3; ++channel)
        values.push_back(static_cast<float>(radiance.at(x, y, 0, channel)));
  return values;
}

TEST_F(LightSymmetry, ImageIsProportionalToTheLightToTheLastBit) {
  const std::vector<float> base = radiance_of(everything(1));
  // Powers of two, so that nothing rounds differently; from very dark to very bright.
  for (const int exponent : {1, -30, 8}) {
    const std::vector<float> scaled = radiance_of(everything(std::ldexp(1.0f, exponent)));
    ASSERT_EQ(scaled.size(), base.size());
    size_t lit = 0;
    for (size_t k = 0; k < base.size(); ++k) {
      ASSERT_EQ(scaled[k], std::ldexp(base[k], exponent)) << k << ", 2^" << exponent;
      lit += base[k] > 0 ? 1 : 0;
    }
    EXPECT_GT(lit, base.size() / 3);
  }
}

/// A quarter turn about the vertical, exact in floating point.
glm::vec3 turned(const glm::vec3& v) {
  return {v.z, v.y, -v.x};
}

scene::Scene turned(scene::Scene scene) {
  for (scene::Vertex& vertex : scene.vertices) {
    vertex.position = turned(vertex.position);
    vertex.normal = turned(vertex.normal);
    vertex.tangent = glm::vec4(turned(glm::vec3(vertex.tangent)), vertex.tangent.w);
  }
  const glm::vec3 low = turned(scene.bounds.min), high = turned(scene.bounds.max);
  scene.bounds = {glm::min(low, high), glm::max(low, high)};
  for (scene::Camera& camera : scene.cameras)
    for (int column = 0; column < 4; ++column)
      camera.world_from_camera[column] =
          glm::vec4(turned(glm::vec3(camera.world_from_camera[column])), camera.world_from_camera[column].w);
  scene.sun->direction = turned(scene.sun->direction);
  for (scene::PunctualLight& light : scene.punctual) {
    light.position = turned(light.position);
    light.direction = turned(light.direction);
  }
  return scene;
}

TEST_F(LightSymmetry, TurningAllOfItByAQuarterChangesNothing) {
  const scene::Scene scene = everything(1);
  const TraceSettings settings{.params = R"("paths": 8, "bounces": 2)", .resolution = 26, .frames = 24};
  TraceSettings other = settings;
  other.seed = 2;
  const std::vector<Images> straight = trace_frames(scene, settings), around = trace_frames(turned(scene), other);
  for (uint32_t channel = 0; channel < 3; ++channel) {
    const std::vector<SampleMean> a = block_estimates(straight, channel, 8), b = block_estimates(around, channel, 8);
    double sum = 0, count = 0;
    for (size_t k = 0; k < a.size(); ++k) {
      if (!(a[k].error() > 0)) continue;  // background
      const double difference = std::abs(a[k].mean() - b[k].mean());
      // Voxels decode their normals and tangents from angles around a fixed axis, a degree of which is felt.
      const double quantised = 0.01 * a[k].mean();
      EXPECT_LT(difference, 4 * std::hypot(a[k].error(), b[k].error()) + quantised) << k << " " << channel;
      sum += std::max(0.0, difference - quantised) / std::hypot(a[k].error(), b[k].error());
      ++count;
    }
    ASSERT_GE(count, 10);
    EXPECT_LT(sum / count, 1.3);
  }
}

TEST_F(LightSymmetry, WhatCannotBeSeenChangesNoBit) {
  const std::vector<float> base = radiance_of(everything(1));
  // A sheet that is cut out entirely, across all of the scene.
  scene::Scene scene = everything(1);
  scene::Scene sheet = make_quad_scene({{{-2, 0.7f, 2}, {4, 0, 0}, {0, 0, -4}, 3}}, {}, scene.cameras.front());
  scene::Material glass = lambertian(glm::vec3(1));
  glass.base_color.a = 0;
  glass.alpha_mode = scene::AlphaMode::mask;
  glass.emission = glm::vec3(0);
  scene.materials.push_back(glass);
  const auto first = static_cast<uint32_t>(scene.vertices.size());
  scene.vertices.insert(scene.vertices.end(), sheet.vertices.begin(), sheet.vertices.end());
  for (scene::Triangle triangle : sheet.triangles)
    scene.triangles.push_back({triangle.a + first, triangle.b + first, triangle.c + first, 3, 3});
  scene.objects.emplace_back("sheet");
  scene.static_vertex_count = static_cast<uint32_t>(scene.vertices.size());
  scene.static_triangle_count = static_cast<uint32_t>(scene.triangles.size());
  scene.features.alpha = true;
  EXPECT_EQ(radiance_of(scene), base);
  // An emissive material that no surface has.
  scene.materials.push_back(glass);
  scene.materials.back().emission = glm::vec3(100);
  EXPECT_EQ(radiance_of(scene), base);
}

}  // namespace
}  // namespace lightloom::test
