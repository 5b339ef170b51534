// Closed rooms: what is known of their light in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/passes/estimator_support.hpp"
#include "tests/passes/light_scenes.hpp"
#include "tests/passes/light_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

constexpr uint32_t kSize = 24;

class ClosedRoom : public DeviceTest {};

/// Passes that trace with the faces of emissive voxels, once for each number of bounces, as trace0, trace1, …
std::string traces(int resolution, const std::vector<int>& bounces, const std::string& params) {
  std::string text = R"("voxelize": { "type": "voxelize", "params": { "resolution": )" + std::to_string(resolution) +
                     R"( } },
    "distance": { "type": "distance_transform", "in": { "voxels": "voxelize.voxels" } },
    "faces": { "type": "emissive_faces", "in": { "voxels": "voxelize.voxels" } },
    "gather": { "type": "gather" })";
  for (const int bounce : bounces)
    text += ", \"trace" + std::to_string(bounce) +
            R"(": { "type": "voxel_path_trace", "in": { "surface": "gather.surface", "voxels": "voxelize.voxels",
                 "distance": "distance.distance", "faces": "faces.faces" },
                 "params": { "nee": "voxel_faces", "bounces": )" +
            std::to_string(bounce) + ", " + params + " } }";
  return text;
}

std::string outputs(const std::vector<int>& bounces) {
  std::string text;
  for (const int bounce : bounces) {
    const std::string name = "trace" + std::to_string(bounce);
    text += (text.empty() ? "\"" : ", \"") + name + "\": \"" + name + ".radiance\"";
  }
  return text;
}

class EmissiveBox : public ClosedRoom, public testing::WithParamInterface<const char*> {};

TEST_P(EmissiveBox, SumsTheSeriesOfItsBounces) {
  const std::vector<int> bounces = {0, 1, 2, 3, 4, 5};
  // About 0.5 and 0.8: voxels hold square roots in 8 bits, and these they hold exactly.
  for (const double root : {180.0 / 255, 228.0 / 255}) {
    const double albedo = root * root;
    scene::Material wall = lambertian(glm::vec3(static_cast<float>(albedo)));
    wall.emission = glm::vec3(2);
    wall.double_sided = true;
    // 32 voxels from wall to wall, so that walls are boundaries of voxels.
    const scene::Scene scene =
        make_quad_scene(room_walls(glm::vec3(-1), glm::vec3(1), 0), {wall}, look_at({0, 0, 0}, {0.3f, -0.2f, 1}, 1.2f));
    GraphRunOptions options;
    options.frames = 8;
    const std::vector<Images> frames =
        run_graph(graph_text(kSize, kSize, kSize, kSize, traces(34, bounces, R"("paths": 8)" + std::string(GetParam())),
                             outputs(bounces)),
                  scene, options);
    for (const int bounce : bounces) {
      // Light scattered 1 to bounce + 1 times, over the albedo that radiance is divided by.
      const double expected = 2 * (1 - std::pow(albedo, bounce + 1)) / (1 - albedo);
      const Estimate whole = image_estimate(frames, "trace" + std::to_string(bounce), 0).whole;
      EXPECT_LT(std::abs(whole.mean - expected), 3 * whole.error + 1e-5 * expected)
          << albedo << " " << bounce << ": " << whole.mean << " +- " << whole.error << ", not " << expected;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Paths, EmissiveBox, testing::Values("", R"(, "roulette": 1)", R"(, "roulette": 3)"), [](const auto& roulette) {
      return "roulette_" + std::string(roulette.index == 0 ? "never" : roulette.index == 1 ? "at_once" : "later");
    });

TEST_F(ClosedRoom, RouletteEndsPathsEarly) {
  scene::Material wall = lambertian(glm::vec3(0.3f));
  wall.double_sided = true;
  const scene::Scene scene =
      make_quad_scene(room_walls(glm::vec3(-1), glm::vec3(1), 0), {wall}, look_at({0, 0, 0}, {0.3f, -0.2f, 1}, 1.2f));
  const auto rays = [&](const std::string& roulette) {
    const Images images =
        run_graph(graph_text(kSize, kSize, kSize, kSize,
                             traces(34, {8}, R"("paths": 4, "strategy": "bsdf", "roulette": )" + roulette),
                             R"("counts": "trace8.counts")"),
                  scene)
            .front();
    double sum = 0;
    for (uint32_t y = 0; y < kSize; ++y)
      for (uint32_t x = 0; x < kSize; ++x) sum += images.at("counts").at(x, y, 0, 0);
    return sum;
  };
  EXPECT_LT(rays("1"), 0.4 * rays("0"));
}

class SealedRooms : public ClosedRoom, public testing::WithParamInterface<std::string> {};

/// Largest and mean value of the room without the lamp.
std::pair<double, double> light_next_door(const std::string& params, const glm::mat3& turn, bool parted) {
  const std::string passes = traces(40, {4}, R"("paths": )" + std::string(parted ? "32, " : "1, ") + params);
  const Images images = run_graph(graph_text(64, 64, 64, 64, passes, outputs({4})),
                                  two_rooms(turn, parted ? Partition::faces_away : Partition::none))
                            .front();
  double largest = 0;
  for (uint32_t y = 0; y < 64; ++y)
    for (uint32_t x = 0; x < 64; ++x) largest = std::max(largest, images.at("trace4").at(x, y, 0, 0));
  return {largest, mean_of(images.at("trace4"), 0, 0, 0, 64, 64)};
}

TEST_P(SealedRooms, LetNothingThrough) {
  for (const glm::mat3& turn : {turned(0, 0), turned(0.4f, 0), turned(0.5f, 0.3f)})
    EXPECT_EQ(light_next_door(GetParam(), turn, true).first, 0);
  EXPECT_GT(light_next_door(GetParam(), turned(0.4f, 0), false).second, 100) << "without a wall between them";
}

INSTANTIATE_TEST_SUITE_P(Marches, SealedRooms, testing::Values(R"("march": "cube_exit")", R"("march": "dda")"),
                         [](const testing::TestParamInfo<std::string>& mode) {
                           return mode.index == 0 ? "cube_exit" : "dda";
                         });

}  // namespace
}  // namespace lightloom::test
