#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/passes/moving_scene.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/graph_runner.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::test {
namespace {

constexpr uint32_t kWidth = 48;
constexpr uint32_t kHeight = 36;
constexpr uint32_t kVanish = 4;  // first frame without the object
constexpr uint32_t kWindow = 10;
constexpr uint32_t kFrames = kVanish + kWindow + 2;

class TemporalGhost : public DeviceTest {};

/// The paper's pipeline at a small size.
std::string small_paper_graph() {
  std::ifstream file(source_dir() / "graphs/paper.json");
  nlohmann::json graph = nlohmann::json::parse(file);
  graph["view"] = {{"width", kWidth}, {"height", kHeight}};
  graph["trace"] = graph["view"];
  graph["params"]["resolution"] = 24;
  graph["outputs"]["accumulated"] = "temporal.radiance";
  graph["outputs"]["id"] = "gather.surface.id";
  return graph.dump();
}

/// Sun from the front, so that the object throws a shadow on the wall, and a sky.
void light(scene::Scene& scene) {
  scene.sun = scene::Sun{glm::normalize(glm::vec3(0.3f, -0.4f, -1)), glm::vec3(6), 0.005f};
  scene.environment.radiance = {0.5f, 0.6f, 0.8f};
  scene.features.sun = scene.features.environment = true;
}

/// The same scene as if the mover had never been: its triangles come last.
scene::Scene without_mover(scene::Scene scene) {
  scene.vertices.resize(scene.static_vertex_count);
  scene.triangles.resize(scene.static_triangle_count);
  scene.objects.resize(1);
  scene.features.dynamic = false;
  scene.source = nullptr;
  return scene;
}

std::vector<Images> run(const scene::Scene& scene) {
  GraphRunOptions options;
  options.frames = kFrames;
  options.seed = 3;
  return run_graph(small_paper_graph(), scene, options);
}

double largest_difference(const Images& a, const Images& b) {
  double largest = 0;
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x)
      for (uint32_t channel = 0; channel < 3; ++channel)
        largest =
            std::max(largest, std::abs(a.at("radiance").at(x, y, 0, channel) - b.at("radiance").at(x, y, 0, channel)));
  return largest;
}

TEST_F(TemporalGhost, AnObjectThatLeavesIsForgottenAfterTenFrames) {
  scene::Scene with = flickering_scene(0, kVanish).scene;
  light(with);
  const std::vector<Images> left = run(with);
  const std::vector<Images> never = run(without_mover(with));
  EXPECT_GT(largest_difference(left[kVanish - 1], never[kVanish - 1]), 0.1) << "it was there";
  for (uint32_t frame = kVanish + kWindow - 1; frame < kFrames; ++frame)
    EXPECT_EQ(largest_difference(left[frame], never[frame]), 0) << frame;
  int uncovered = 0;
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x) {
      if (left[kVanish - 1].at("id").at(x, y, 0, 0) != 2) continue;
      ++uncovered;
      for (uint32_t frame = kVanish; frame < kFrames; ++frame)
        ASSERT_EQ(left[frame].at("accumulated").at(x, y, 0, 3), std::min(frame - kVanish + 1, kWindow))
            << "rejected at once, and no frame longer than needed";
    }
  EXPECT_GT(uncovered, 60);
}

}  // namespace
}  // namespace lightloom::test
