#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/passes/light_support.hpp"
#include "tests/passes/moving_scene.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

constexpr uint32_t kWidth = 64;
constexpr uint32_t kHeight = 48;
constexpr double kTolerance = 0.01;  // [pixels]

class GatherMotion : public DeviceTest {};

std::vector<Images> run(const scene::Scene& scene, uint32_t frames) {
  GraphRunOptions options;
  options.frames = frames;
  return run_graph(graph_text(kWidth, kHeight, kWidth, kHeight, R"("g": { "type": "gather" })",
                              R"("motion": "g.motion", "position": "g.surface.position", "id": "g.surface.id")"),
                   scene, options);
}

glm::dvec2 motion_at(const Images& images, uint32_t x, uint32_t y) {
  return {images.at("motion").at(x, y, 0, 0), images.at("motion").at(x, y, 0, 1)};
}

/// What the host expects; nothing where the point was behind the earlier camera.
std::optional<glm::dvec2> expected(const MovingScene& moving, const Images& images, uint32_t frame, uint32_t x,
                                   uint32_t y) {
  const glm::dvec2 centre(x + 0.5, y + 0.5);
  const auto id = static_cast<uint32_t>(images.at("id").at(x, y, 0, 0));
  std::optional<glm::dvec2> before;
  if (id == 0) {
    const HostCamera earlier = moving.camera(frame - 1);
    before = earlier.project(earlier.eye + moving.camera(frame).ray(centre, kWidth, kHeight), kWidth, kHeight);
  } else {
    const image::HostImage& position = images.at("position");
    const glm::dvec3 now(position.at(x, y, 0, 0), position.at(x, y, 0, 1), position.at(x, y, 0, 2));
    before = moving.camera(frame - 1).project(moving.follow(id - 1, now, frame, frame - 1), kWidth, kHeight);
  }
  if (!before) return std::nullopt;
  return *before - centre;
}

/// Compares all pixels of frames 1 on; returns how far the farthest moved.
double check(const MovingScene& moving, uint32_t frames) {
  const std::vector<Images> images = run(moving.scene, frames);
  double farthest = 0;
  for (uint32_t frame = 1; frame < frames; ++frame) {
    std::array<int, 3> seen{};
    for (uint32_t y = 0; y < kHeight; ++y) {
      for (uint32_t x = 0; x < kWidth; ++x) {
        const std::optional<glm::dvec2> wanted = expected(moving, images[frame], frame, x, y);
        if (!wanted) continue;
        EXPECT_LT(glm::distance(motion_at(images[frame], x, y), *wanted), kTolerance)
            << "frame " << frame << ", pixel " << x << ' ' << y;
        if (::testing::Test::HasFailure()) return farthest;
        ++seen[static_cast<size_t>(images[frame].at("id").at(x, y, 0, 0))];
        farthest = std::max(farthest, glm::length(*wanted));
      }
    }
    EXPECT_GT(seen[2], 50) << "the mover is in the picture, frame " << frame;
  }
  return farthest;
}

TEST_F(GatherMotion, IsNoughtInTheFirstFrameAndWhereNothingMoves) {
  const MovingScene moving = translating_scene({0, 0, 0}, {0.05, 0.02, 0.01}, 1);
  const std::vector<Images> frames = run(moving.scene, 3);
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x) {
      ASSERT_EQ(motion_at(frames[0], x, y), glm::dvec2(0));
      if (frames[2].at("id").at(x, y, 0, 0) != 1) continue;
      ASSERT_EQ(motion_at(frames[2], x, y), glm::dvec2(0));
    }
}

TEST_F(GatherMotion, FollowsATranslation) {
  EXPECT_GT(check(translating_scene({-0.3, 0, 0}, {0.07, 0.03, 0.1}, 1), 5), 2);
}

TEST_F(GatherMotion, FollowsARotation) {
  EXPECT_GT(check(rotating_scene({0.2, 1, 0.5}, 0.2, 1.4), 5), 2);
}

TEST_F(GatherMotion, FollowsASkin) {
  EXPECT_GT(check(skinned_scene({0.06, 0, 0.05}), 6), 1);
}

TEST_F(GatherMotion, FollowsAMorphTarget) {
  EXPECT_GT(check(morphed_scene({-0.06, 0, 0.05}), 6), 1);
}

TEST_F(GatherMotion, FollowsTheCameraAndTheSkyBehind) {
  MovingScene moving = dolly_scene({0.04, 0.02, -0.1}, 0.05);
  EXPECT_GT(check(moving, 5), 2);
  // Turned away from the wall it sees past its edge.
  moving = dolly_scene({0.04, 0.02, 0}, 0.3);
  const std::vector<Images> frames = run(moving.scene, 4);
  int sky = 0;
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x) {
      const std::optional<glm::dvec2> wanted = expected(moving, frames[3], 3, x, y);
      if (frames[3].at("id").at(x, y, 0, 0) != 0 || !wanted) continue;
      ++sky;
      // Far away means large numbers near the edge of what the earlier camera could see.
      ASSERT_LT(glm::distance(motion_at(frames[3], x, y), *wanted), kTolerance + 1e-4 * glm::length(*wanted));
    }
  EXPECT_GT(sky, 100);
}

TEST_F(GatherMotion, ADisabledReaderCostsNothingAndChangesNothing) {
  const MovingScene moving = translating_scene({0, 0, 0}, {0.05, 0.02, 0.01}, 1);
  GraphRunOptions options;
  options.frames = 2;
  const std::vector<Images> without =
      run_graph(graph_text(kWidth, kHeight, kWidth, kHeight, R"("g": { "type": "gather" })",
                           R"("position": "g.surface.position")"),
                moving.scene, options);
  EXPECT_TRUE(without[1].at("position").texels == run(moving.scene, 2)[1].at("position").texels);
}

}  // namespace
}  // namespace lightloom::test
