#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/passes/moving_scene.hpp"
#include "tests/passes/temporal_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

constexpr uint32_t kSize = kTemporalSize;
constexpr uint32_t kWindow = 10;  // frames

/// With what earlier frames saw in images of the G-buffer, or packed (the param).
class TemporalMotion : public DeviceTest, public ::testing::WithParamInterface<bool> {
 protected:
  void SetUp() override { DeviceTest::SetUp(); }

  static std::vector<Images> run(const scene::Scene& scene, uint32_t frames, const std::string& pattern = "texture") {
    GraphRunOptions options;
    options.frames = frames;
    options.extra_types = {make_pattern(), make_test_displace()};
    options.capture = {"gather.surface.position", "gather.surface.id"};
    return run_graph(temporal_graph(pattern, "", "gather.surface.position", GetParam()), scene, options);
  }
};

uint32_t object_at(const Images& images, uint32_t x, uint32_t y) {
  return static_cast<uint32_t>(images.at("gather.surface.id").at(x, y, 0, 0));
}

double weight_at(const Images& images, uint32_t x, uint32_t y) {
  return images.at("radiance").at(x, y, 0, 3);
}

/// How many of the last ten frames showed the point that frame `frame` shows at a pixel, by the host's own projection
/// and by what those frames' own G-buffers hold. Nothing where rounding decides.
std::optional<double> frames_that_saw(const MovingScene& moving, const std::vector<Images>& frames, uint32_t frame,
                                      uint32_t x, uint32_t y) {
  const uint32_t object = object_at(frames[frame], x, y);
  const image::HostImage& position = frames[frame].at("gather.surface.position");
  const glm::dvec3 now(position.at(x, y, 0, 0), position.at(x, y, 0, 1), position.at(x, y, 0, 2));
  double count = 1;
  for (uint32_t age = 1; age < kWindow && age <= frame; ++age) {
    const glm::dvec3 then = moving.follow(object - 1, now, frame, frame - age);
    const std::optional<glm::dvec2> place = moving.camera(frame - age).project(then, kSize, kSize);
    if (!place) continue;
    const glm::dvec2 to_border = glm::abs(*place - glm::round(*place));
    if (std::min(to_border.x, to_border.y) < 2e-3) return std::nullopt;
    if (place->x < 0 || place->y < 0 || place->x > kSize || place->y > kSize) continue;
    count += object_at(frames[frame - age], static_cast<uint32_t>(place->x), static_cast<uint32_t>(place->y)) == object;
  }
  return count;
}

struct Tally {
  int mover = 0;       ///< pixels compared on the moving object
  int full = 0;        ///< those of them with all ten frames
  int fresh_wall = 0;  ///< pixels of the wall with fewer
};

/// The sum of the weights of every pixel of a frame is the number of frames that saw its point.
Tally check(const MovingScene& moving, const std::vector<Images>& frames, uint32_t frame) {
  Tally tally;
  for (uint32_t y = 0; y < kSize; ++y) {
    for (uint32_t x = 0; x < kSize; ++x) {
      const uint32_t object = object_at(frames[frame], x, y);
      if (object == 0) continue;
      const std::optional<double> expected = frames_that_saw(moving, frames, frame, x, y);
      if (!expected) continue;
      EXPECT_EQ(weight_at(frames[frame], x, y), *expected) << "frame " << frame << ", pixel " << x << ' ' << y;
      if (::testing::Test::HasFailure()) return tally;
      tally.mover += object == 2;
      tally.full += object == 2 && *expected == kWindow;
      tally.fresh_wall += object == 1 && *expected < kWindow;
    }
  }
  return tally;
}

/// Largest difference between the accumulated and the current texture on the moving object, where all frames count.
double largest_smear(const Images& images) {
  double largest = 0;
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x) {
      if (object_at(images, x, y) != 2 || weight_at(images, x, y) < kWindow) continue;
      for (uint32_t channel = 0; channel < 2; ++channel)
        largest = std::max(
            largest, std::abs(images.at("radiance").at(x, y, 0, channel) - images.at("current").at(x, y, 0, channel)));
    }
  return largest;
}

TEST_P(TemporalMotion, ATranslatingObjectKeepsItsHistoryAndUncoversNone) {
  const MovingScene moving = translating_scene({-0.9, 0.1, 0}, {0.0917, 0.0113, 0.0371}, 0.9);
  const std::vector<Images> frames = run(moving.scene, 13);
  const Tally tally = check(moving, frames, 12);
  EXPECT_GT(tally.full, 300);
  EXPECT_GT(tally.fresh_wall, 200);
  // 20 pixels across: within a pixel, ten nearest texels average to less than half of one.
  EXPECT_LT(largest_smear(frames[12]), 0.5 / 20);
}

TEST_P(TemporalMotion, WithoutTheMotionItWouldLoseItsHistory) {
  MovingScene moving = translating_scene({-0.9, 0.1, 0}, {0.0917, 0.0113, 0.0371}, 0.9);
  moving.scene.features.dynamic = false;
  const std::vector<Images> frames = run(moving.scene, 13);
  double most = 0;
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x)
      if (object_at(frames[12], x, y) == 2) most = std::max(most, weight_at(frames[12], x, y));
  EXPECT_LT(most, kWindow);
}

TEST_P(TemporalMotion, ARotatingObjectKeepsItsHistory) {
  for (const glm::dvec3& axis : {glm::dvec3(0, 0, 1), glm::dvec3(0.1, 1, 0.2)}) {
    const MovingScene moving = rotating_scene(axis, 0.0619, 1.2);
    const std::vector<Images> frames = run(moving.scene, 16);
    const Tally tally = check(moving, frames, 15);
    EXPECT_GT(tally.full, 250);
    EXPECT_GT(tally.fresh_wall, 10);
    EXPECT_LT(largest_smear(frames[15]), 1.0 / 25);
  }
}

TEST_P(TemporalMotion, SkinnedAndMorphedObjectsKeepTheirs) {
  for (const MovingScene& moving : {skinned_scene({0.0517, 0, 0.0231}), morphed_scene({-0.0517, 0, 0.0231})}) {
    const std::vector<Images> frames = run(moving.scene, 13);
    const Tally tally = check(moving, frames, 12);
    EXPECT_GT(tally.full, 300);
    EXPECT_LT(largest_smear(frames[12]), 0.75 / 20);
  }
}

TEST_P(TemporalMotion, FastMotionKeepsWhatIsInView) {
  // Nine pixels a frame: nothing overlaps with where it was.
  const MovingScene moving = translating_scene({-2.4, 0, 0.3}, {0.4517, 0, 0}, 0.4);
  const std::vector<Images> frames = run(moving.scene, 9);
  const Tally tally = check(moving, frames, 6);
  EXPECT_GT(tally.mover, 50);
  EXPECT_GT(tally.fresh_wall, 100);
}

TEST_P(TemporalMotion, TheCamerasMotionAndTheObjectsAddUp) {
  const MovingScene moving = dolly_scene({0.0317, 0.0119, -0.0413}, 0.0091);
  EXPECT_GT(check(moving, run(moving.scene, 13), 12).full, 300);
}

TEST_P(TemporalMotion, ACutKeepsWhatBothViewsSee) {
  const MovingScene moving = cut_scene({0.4123, 0.2071, -0.3119}, 6);
  const std::vector<Images> frames = run(moving.scene, 12);
  for (const uint32_t frame : {6u, 8u, 11u}) check(moving, frames, frame);
  int rejected = 0;
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x) rejected += weight_at(frames[6], x, y) < 7 ? 1 : 0;
  EXPECT_GT(rejected, 50) << "what the other view did not see starts anew";
  // A cut to elsewhere: nothing is common, and nothing of the other view is left.
  const MovingScene far = cut_scene({0, 0, -5}, 6);
  const std::vector<Images> elsewhere = run(far.scene, 7);
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x) ASSERT_LE(weight_at(elsewhere[6], x, y), 1);
}

TEST_P(TemporalMotion, WhatAppearsStartsAnewAndWhatVanishesLeavesNothing) {
  const MovingScene moving = flickering_scene(4, 8);
  const std::vector<Images> frames = run(moving.scene, 20);
  std::array<int, 2> seen{};
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x) {
      if (object_at(frames[5], x, y) != 2) continue;
      ++seen[0];
      ASSERT_EQ(object_at(frames[3], x, y), 1u);
      for (const uint32_t frame : {4u, 5u, 7u}) ASSERT_EQ(weight_at(frames[frame], x, y), frame - 3.0) << frame;
      // The wall: seen in frames 0 to 3 and again from 8 on.
      for (const auto& [frame, count] : {std::pair{8u, 5}, {9u, 6}, {12u, 6}, {14u, 7}, {17u, 10}})
        ASSERT_EQ(weight_at(frames[frame], x, y), count) << frame;
    }
  EXPECT_GT(seen[0], 100);
}

TEST_P(TemporalMotion, IdsTellCoplanarObjectsApart) {
  // A sheet that lies on the wall is pulled away: neither position nor normal tells it from the wall.
  const MovingScene moving = jumping_scene({-0.6, 0, -0.98}, {0.7, 0, -0.98}, 6);
  const std::vector<Images> frames = run(moving.scene, 7, "object");
  std::string blind_graph = temporal_graph("object");
  const std::string edge = R"("trail_id": "gather.surface.id@1..9")";
  blind_graph.erase(blind_graph.find(edge), edge.size());
  blind_graph.erase(blind_graph.rfind(',', blind_graph.find("}, \"params\"", blind_graph.find("trail_normal"))), 1);
  const std::vector<Images> blind = run_temporal(moving.scene, blind_graph, 7);
  int uncovered = 0;
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x) {
      if (object_at(frames[5], x, y) != 2 || object_at(frames[6], x, y) != 1) continue;
      ++uncovered;
      ASSERT_EQ(weight_at(frames[6], x, y), 1) << "at once";
      ASSERT_EQ(frames[6].at("radiance").at(x, y, 0, 0), frames[6].at("current").at(x, y, 0, 0));
      ASSERT_EQ(blind[6].at("radiance").at(x, y, 0, 3), 7) << "without ids";
    }
  EXPECT_GT(uncovered, 60);
  EXPECT_GT(check(moving, frames, 6).mover, 60);
}

INSTANTIATE_TEST_SUITE_P(Trails, TemporalMotion, ::testing::Bool(),
                         [](const auto& given) { return given.param ? "Packed" : "InImages"; });

}  // namespace
}  // namespace lightloom::test
