// The tracer's param `sampling`: the same mean, less noise.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numeric>

#include "framework/base/file.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/graph_runner.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::test {
namespace {

class Sampling : public DeviceTest {
 protected:
  /// What the paths alone make of the atrium, all channels of all pixels, the mean over some frames.
  [[nodiscard]] std::vector<double> traced(const char* sampling, int paths, uint32_t frames) const {
    nlohmann::ordered_json graph =
        nlohmann::ordered_json::parse(read_text_file(source_dir() / "graphs/lightloom.json"));
    graph["view"] = graph["trace"] = {{"width", 64}, {"height", 48}};
    graph["params"]["resolution"] = 24;
    graph["passes"]["trace"]["params"]["sampling"] = sampling;
    graph["passes"]["trace"]["params"]["paths"] = paths;
    graph["outputs"] = {{"diffuse", "trace.diffuse"}};
    GraphRunOptions options;
    options.frames = frames;
    std::vector<double> mean;
    visit_frames(graph.dump(), atrium_, options, [&](uint32_t, Images images) {
      const image::HostImage& image = images.at("diffuse");
      mean.resize(64 * 48 * 3);
      for (uint32_t i = 0; i < mean.size(); ++i)
        mean[i] += image.at(i / 3 % 64, i / 192, 0, i % 3) / static_cast<double>(frames);
    });
    return mean;
  }

  static double squared_error(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]) / (b[i] * b[i] + 0.01);
    return sum / static_cast<double>(a.size());
  }

  scene::Scene atrium_ = scene::load_scene(source_dir() / "samples/scenes/atrium.scene.json");
};

TEST_F(Sampling, LowDiscrepancyHasTheSameMeanWithLessNoise) {
  const std::vector<double> converged = traced("independent", 128, 4);
  const std::vector<double> long_even = traced("low_discrepancy", 128, 4);
  EXPECT_NEAR(std::accumulate(long_even.begin(), long_even.end(), 0.0) /
                  std::accumulate(converged.begin(), converged.end(), 0.0),
              1, 0.005);
  const double independent = squared_error(traced("independent", 16, 1), converged);
  const double even = squared_error(traced("low_discrepancy", 16, 1), converged);
  EXPECT_LT(squared_error(long_even, converged), independent / 8);
  EXPECT_LT(even, 0.9 * independent);
  RecordProperty("ratio", std::to_string(even / independent));
}

}  // namespace
}  // namespace lightloom::test
