// Rays that leave a surface do not meet it again, whatever its size, place and orientation.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "framework/reference/triangle_geometry.hpp"
#include "tests/support/tracing.hpp"

namespace lightloom::test {
namespace {

struct Extremes {
  float place, size;  ///< distance from the origin of the world, length of edges [m]
};

class ReferenceSelfHit : public testing::TestWithParam<Extremes> {};

TEST_P(ReferenceSelfHit, RaysLeaveTheirTriangle) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<float> within(-1, 1);
  const auto vector = [&] { return glm::vec3(within(engine), within(engine), within(engine)); };
  SceneBuilder builder;
  scene::Material material = matte(glm::vec3(1));
  material.double_sided = true;
  const uint32_t white = builder.material(material);
  constexpr int kTriangles = 300;
  std::vector<glm::vec3> corners;
  for (int i = 0; i < kTriangles; ++i) {
    const glm::vec3 place = vector() * GetParam().place;
    for (int k = 0; k < 3; ++k) corners.push_back(place + vector() * GetParam().size);
  }
  uint32_t hits = 0, rays = 0;
  // One triangle at a time, so that whatever a ray meets is the one it left.
  for (int i = 0; i < kTriangles; ++i) {
    SceneBuilder alone;
    alone.material(builder.scene.materials[white]);
    alone.triangle(corners[i * 3], corners[i * 3 + 1], corners[i * 3 + 2], 0);
    const scene::Scene scene = alone.finish({});
    const scene::Pose pose{{}, scene.cameras, {}};
    scene::FrameScene frame;
    frame.scene = &scene;
    frame.pose = &pose;
    const reference::StaticScene fixed(scene);
    const reference::TriangleGeometry geometry(fixed, frame);
    for (int k = 0; k < 2000; ++k) {
      const glm::vec2 u(std::abs(within(engine)), std::abs(within(engine)));
      const reference::TriangleHit at{{0, std::min(u.x, u.y), std::abs(u.x - u.y)}, 1};
      const reference::SurfacePoint point = geometry.surface({{}, glm::normalize(vector())}, at);
      glm::vec3 direction = glm::normalize(vector());
      // Grazing rays as well.
      if (k % 2 == 0)
        direction =
            glm::normalize(direction - 0.999f * point.geometric_normal * glm::dot(direction, point.geometric_normal));
      if (glm::dot(direction, point.geometric_normal) <= 0) direction = -direction;
      ++rays;
      hits += geometry.closest_hit({point.origin, direction}) ? 1 : 0;
    }
  }
  EXPECT_EQ(hits, 0U) << "of " << rays;
}

INSTANTIATE_TEST_SUITE_P(Scales, ReferenceSelfHit,
                         testing::Values(Extremes{0, 1}, Extremes{10, 1}, Extremes{1e5f, 30}, Extremes{1, 1e-3f},
                                         Extremes{1e-3f, 1e-5f}, Extremes{1, 1e4f}, Extremes{1e6f, 1e6f}));

}  // namespace
}  // namespace lightloom::test
