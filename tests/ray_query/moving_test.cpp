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

TEST_F(RayQueryMoving, ShadowsFollowWhatThrowsThem) {
  const std::vector<Images> frames =
      trace_rays(moving_square(), {.params = R"("paths": 1, "strategy": "nee")", .bounces = {0}, .frames = kFrames});
  for (int frame = 0; frame < kFrames; ++frame) {
    const double center = 0.3 * frame - 0.6;
    int shaded = 0;
    for (uint32_t y = 0; y < 32; ++y)
      for (uint32_t x = 0; x < 32; ++x) {
        const glm::dvec3 p = surface_position(frames[static_cast<size_t>(frame)], x, y);
        ASSERT_NEAR(p.y, 0, 1e-5);
        const double inside = std::max(std::abs(p.x - center), std::abs(p.z)) - 0.5;
        if (std::abs(inside) < 1e-3) continue;
        const double expected = inside < 0 ? 0 : 3 / kPi;
        ASSERT_NEAR(frames[static_cast<size_t>(frame)].at("radiance").at(x, y, 0, 0), expected, 1e-4)
            << "frame " << frame << " at " << x << " " << y;
        shaded += inside < 0 ? 1 : 0;
      }
    EXPECT_GT(shaded, 80);
  }
}

}  // namespace
}  // namespace lightloom::test
