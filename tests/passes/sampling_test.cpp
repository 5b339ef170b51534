// The tracer's param `sampling`: the same mean, less noise.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "framework/base/file.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/graph_runner.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::test {
namespace {

/// A matt floor under a constant sky, of which a roof hides a part.
scene::Scene floor_below_a_roof() {
  scene::Scene scene = make_quad_scene({{{-2, 0, -2}, {0, 0, 4}, {4, 0, 0}}, {{-2, 1, -2}, {2, 0, 0}, {0, 0, 4}}}, {},
                                       look_at({1.2f, 0.9f, 0}, {0, 0, 0.1f}, 0.9f));
  scene.environment.radiance = {1, 0.8f, 0.6f};
  scene.features.environment = true;
  return scene;
}

class Sampling : public DeviceTest {
 protected:
  /// What the paths alone make of the floor, all channels of all pixels, the mean over some frames.
  [[nodiscard]] std::vector<double> traced(const char* sampling, int paths, uint32_t frames) const {
    nlohmann::ordered_json graph =
        nlohmann::ordered_json::parse(read_text_file(source_dir() / "graphs/lightloom.json"));
    graph["view"] = graph["trace"] = {{"width", 64}, {"height", 48}};
    graph["params"]["resolution"] = 24;
    graph["params"]["bounces"] = 0;
    graph["passes"]["trace"]["params"]["sampling"] = sampling;
    graph["passes"]["trace"]["params"]["paths"] = paths;
    graph["outputs"] = {{"diffuse", "trace.diffuse"}};
    GraphRunOptions options;
    options.frames = frames;
    std::vector<double> mean;
    visit_frames(graph.dump(), floor_, options, [&](uint32_t, Images images) {
      const image::HostImage& image = images.at("diffuse");
      mean.resize(64 * 48 * 3);
      for (uint32_t i = 0; i < mean.size(); ++i)
        mean[i] += image.at(i / 3 % 64, i / 192, 0, i % 3) / static_cast<double>(frames);
    });
    return mean;
  }

  static double error_of(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
    return sum / static_cast<double>(a.size());
  }

  scene::Scene floor_ = floor_below_a_roof();
};

TEST_F(Sampling, LowDiscrepancyHasTheSameMeanWithLessNoise) {
  const std::vector<double> converged = traced("independent", 128, 4);
  const std::vector<double> long_even = traced("low_discrepancy", 128, 4);
  EXPECT_NEAR(std::accumulate(long_even.begin(), long_even.end(), 0.0) /
                  std::accumulate(converged.begin(), converged.end(), 0.0),
              1, 0.005);
  const double independent = error_of(traced("independent", 16, 1), converged);
  const double even = error_of(traced("low_discrepancy", 16, 1), converged);
  EXPECT_LT(error_of(long_even, converged), independent / 3);
  EXPECT_LT(even, 0.75 * independent);
}

}  // namespace
}  // namespace lightloom::test
