// What moves is met where it is in each frame.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/passes/moving_support.hpp"
#include "tests/ray_query/ray_query_support.hpp"

namespace lightloom::test {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr int kFrames = 5;

class RayQueryMoving : public RayQueryTest {};

/// A floor under a sun straight above, and a square half a metre over it, 1 m wide, that moves along x. It faces down,
/// so that the viewer above does not see it; light does.
scene::Scene moving_square() {
  scene::Scene scene =
      make_quad_scene({square_floor(2)}, {lambertian(glm::vec3(0.5f))}, orthographic({0, 4, 0}, {0, 0, 0}, 1.6f));
  scene.sun = scene::Sun{glm::vec3(0, -1, 0), glm::vec3(3), 0};
  scene.features.sun = true;
  const glm::vec3 a(-0.5f, 0.5f, 0.5f), b(0.5f, 0.5f, 0.5f), c(0.5f, 0.5f, -0.5f), d(-0.5f, 0.5f, -0.5f);
  MovingObject square;
  square.triangles = {{a, c, b}, {a, d, c}};
  square.material = lambertian(glm::vec3(0.5f));
  for (int frame = 0; frame < kFrames; ++frame)
    square.placements.push_back({{0.3f * static_cast<float>(frame) - 0.6f, 0, 0}, {1, 0, 0, 0}, 1});
  return with_moving(std::move(scene), {square});
}

/// Expects a sharp shadow under the square in each frame, or none.
void expect_shadows(const std::vector<Images>& frames, bool any) {
  for (int frame = 0; frame < kFrames; ++frame) {
    const Images& images = frames[static_cast<size_t>(frame)];
    const double center = 0.3 * frame - 0.6;
    int shaded = 0;
    for (uint32_t y = 0; y < 32; ++y)
      for (uint32_t x = 0; x < 32; ++x) {
        const glm::dvec3 p = surface_position(images, x, y);
        ASSERT_NEAR(p.y, 0, 1e-5);
        const double inside = std::max(std::abs(p.x - center), std::abs(p.z)) - 0.5;
        if (std::abs(inside) < 1e-3) continue;
        const bool dark = any && inside < 0;
        ASSERT_NEAR(images.at("radiance").at(x, y, 0, 0), dark ? 0 : 3 / kPi, 1e-4)
            << "frame " << frame << " at " << x << " " << y;
        shaded += dark ? 1 : 0;
      }
    EXPECT_EQ(shaded > 80, any);
  }
}

const RaySettings kDirectLight{.params = R"("paths": 1, "strategy": "nee")", .bounces = {0}, .frames = kFrames};

TEST_F(RayQueryMoving, ShadowsFollowWhatThrowsThem) {
  expect_shadows(trace_rays(moving_square(), kDirectLight), true);
}

TEST_F(RayQueryMoving, WhatIsCutOutThrowsNone) {
  for (const float alpha : {0.2f, 0.8f}) {
    scene::Scene scene = moving_square();
    scene.materials.back().alpha_mode = scene::AlphaMode::mask;
    scene.materials.back().base_color.a = alpha;
    scene.features.alpha = true;
    expect_shadows(trace_rays(scene, kDirectLight), alpha > 0.5f);
  }
}

}  // namespace
}  // namespace lightloom::test
