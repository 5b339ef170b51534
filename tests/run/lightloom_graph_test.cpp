// graphs/lightloom.json on the device: what its choices are worth, with validation on.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "framework/base/file.hpp"
#include "framework/scene/scene.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/graph_runner.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::test {
namespace {

constexpr uint32_t kWidth = 96, kHeight = 72, kFrames = 10;

class LightloomGraph : public DeviceTest {};

/// One of the graphs that ship, small; light is traced at `trace_scale` of the picture's size.
std::string small_graph(const std::string& name, double trace_scale = 1) {
  nlohmann::ordered_json graph = nlohmann::ordered_json::parse(read_text_file(source_dir() / "graphs" / name));
  graph["view"] = {{"width", kWidth}, {"height", kHeight}};
  graph["trace"] = {{"width", std::lround(kWidth * trace_scale)}, {"height", std::lround(kHeight * trace_scale)}};
  graph["params"]["resolution"] = 48;
  return graph.dump();
}

const scene::Scene& atrium() {
  static const scene::Scene scene = scene::load_scene(source_dir() / "samples/scenes/atrium.scene.json");
  return scene;
}

std::vector<Images> run(const std::string& graph, const std::vector<std::string>& variants, const std::string& paths,
                        uint32_t seed, const scene::Scene& scene = atrium(), const std::string& camera = "detail") {
  GraphRunOptions options;
  options.frames = kFrames;
  options.seed = seed;
  options.camera = camera;
  options.link.variants = variants;
  options.link.sets = {{"paths", paths}};
  return run_graph(graph, scene, options);
}

TEST_F(LightloomGraph, GivesTheSameBitsWhetherValuesShareMemoryOrNot) {
  for (const char* name : {"lightloom.json", "paper.json"}) {
    GraphRunOptions options;
    options.frames = 3;
    options.link.captures = {"*"};
    const std::vector<Images> shared = run_graph(small_graph(name, 0.5), atrium(), options);
    options.share_memory = false;
    const std::vector<Images> apart = run_graph(small_graph(name, 0.5), atrium(), options);
    for (uint32_t frame = 0; frame < options.frames; ++frame)
      for (const auto& [value, image] : apart[frame])
        EXPECT_TRUE(image.texels == shared[frame].at(value).texels) << name << ", frame " << frame << ": " << value;
  }
}

TEST_F(LightloomGraph, ASceneHeldStillLooksAsItDidAtThatTime) {
  GraphRunOptions options;
  options.frames = 4;
  options.link.captures = {"gather.surface.position", "voxelize_dynamic.voxels.albedo"};
  const std::vector<Images> moving = run_graph(small_graph("lightloom.json", 0.5), atrium(), options);
  options.frozen_time = 3 / 30.0;
  const std::vector<Images> still = run_graph(small_graph("lightloom.json", 0.5), atrium(), options);
  for (const auto& [name, image] : moving[3]) {
    if (name == "radiance" || name == "image") continue;
    EXPECT_FALSE(image.texels == moving[0].at(name).texels) << name << " does not move, so this says nothing";
    for (const Images& frame : still) EXPECT_TRUE(frame.at(name).texels == image.texels) << name;
  }
}

using Colors = std::vector<double>;

/// Red, green and blue, compressed to [0, 1): one lamp or one spark must not outweigh the picture.
Colors compressed(const std::vector<const image::HostImage*>& frames) {
  Colors colors;
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x)
      for (uint32_t c = 0; c < 3; ++c) {
        double sum = 0;
        for (const image::HostImage* frame : frames) sum += frame->at(x, y, 0, c);
        const double mean = sum / static_cast<double>(frames.size());
        colors.push_back(mean / (1 + mean));
      }
  return colors;
}

Colors last_frame(const std::vector<Images>& frames) {
  return compressed({&frames.back().at("radiance")});
}

double rms(const Colors& a, const Colors& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

TEST_F(LightloomGraph, EachOfItsFiltersBringsThePictureNearerToALongAverage) {
  const std::string graph = small_graph("lightloom.json");
  const std::vector<Images> average = run(graph, {"raw"}, "8", 77);
  std::vector<const image::HostImage*> all;
  for (const Images& frame : average) all.push_back(&frame.at("radiance"));
  const Colors truth = compressed(all);
  const double full = rms(last_frame(run(graph, {}, "1", 0)), truth);
  const double raw = rms(last_frame(run(graph, {"raw"}, "1", 0)), truth);
  const double no_denoise = rms(last_frame(run(graph, {"no_denoise"}, "1", 0)), truth);
  const double no_temporal = rms(last_frame(run(graph, {"no_temporal"}, "1", 0)), truth);
  const double paper = rms(last_frame(run(small_graph("paper.json"), {}, "1", 0)), truth);
  RecordProperty("full", std::to_string(full));
  RecordProperty("paper", std::to_string(paper));
  EXPECT_LT(full, no_denoise);
  EXPECT_LT(full, no_temporal);
  EXPECT_LT(no_denoise, raw);
  EXPECT_LT(no_temporal, raw);
  EXPECT_LT(full, 0.9 * paper) << "what is better about it";
}

TEST_F(LightloomGraph, EveryPixelIsANumber) {
  for (const double scale : {1.0, 0.5}) {
    const std::vector<Images> frames = run(small_graph("lightloom.json", scale), {}, "1", 3);
    for (uint32_t y = 0; y < kHeight; ++y)
      for (uint32_t x = 0; x < kWidth; ++x)
        for (uint32_t c = 0; c < 3; ++c) {
          const double value = frames.back().at("radiance").at(x, y, 0, c);
          ASSERT_TRUE(std::isfinite(value) && value >= 0) << x << " " << y << " " << value;
        }
  }
}

TEST_F(LightloomGraph, ASceneWithoutReflectionsLooksTheSameWithoutTheirChain) {
  scene::Scene scene = make_quad_scene({{{-2, 0, 2}, {4, 0, 0}, {0, 0, -4}}, {{-2, 0, -1}, {4, 0, 0}, {0, 3, 0}}},
                                       {white_lambertian()}, look_at({0.5f, 1.5f, 4}, {0, 0.5f, 0}, 0.8f));
  scene.environment.radiance = {1, 0.8f, 0.6f};
  scene.features.environment = true;
  const std::string graph = small_graph("lightloom.json", 0.5);
  const Colors general = last_frame(run(graph, {}, "1", 5, scene, ""));
  scene.features.specular = false;
  const Colors special = last_frame(run(graph, {}, "1", 5, scene, ""));
  EXPECT_LT(rms(general, special), 1e-6);
  EXPECT_GT(rms(special, Colors(special.size(), 0.0)), 0.1);
}

}  // namespace
}  // namespace lightloom::test
