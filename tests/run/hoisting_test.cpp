// Hoisting on the device: what runs once gives the bits that running it in every frame gives.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "framework/base/file.hpp"
#include "framework/run/compile_graph.hpp"
#include "framework/run/executor.hpp"
#include "framework/run/provenance.hpp"
#include "passes/registry.hpp"
#include "tests/run/toy_types.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::run {
namespace {

using test::GraphRunOptions;
using test::Images;

/// Records how often it is recorded.
PassType ramp_type(int& recorded) {
  PassType type =
      toy::one_shader_type("test_ramp", {toy::image_port("ramp", Direction::out)}, "test_ramp.comp", "ramp");
  type.record = [&recorded, dispatch = type.record](PassContext& context) {
    ++recorded;
    dispatch(context);
  };
  return type;
}

PassType counter_type() {
  PassType type = toy::one_shader_type(
      "test_counter", {toy::image_port("previous", Direction::in), toy::image_port("count", Direction::out)},
      "test_counter.comp", "count");
  type.params = {{"start", ParamType::real, 0.0, {}, {}, {}, "", ""}};
  return type;
}

/// `next` is the same in every frame, `sum` is not, as it has a history; the ramp itself is an output.
constexpr const char* kRamp = R"({ "lightloom": 1, "name": "ramp",
  "view": { "width": 20, "height": 9 }, "trace": { "width": 20, "height": 9 },
  "passes": {
    "ramp": { "type": "test_ramp" },
    "next": { "type": "test_counter", "in": { "previous": "ramp.ramp" } },
    "past": { "type": "test_counter", "in": { "previous": "last.count@1" } },
    "last": { "type": "test_counter", "in": { "previous": "next.count" } }
  },
  "outputs": { "ramp": "ramp.ramp", "past": "past.count", "last": "last.count" } })";

class HoistingTest : public test::DeviceTest {};

TEST_F(HoistingTest, AHoistedPassIsRecordedOnceAndReadInEveryFrame) {
  for (const bool hoist : {true, false}) {
    int recorded = 0;
    GraphRunOptions options;
    options.frames = 5;
    options.extra_types = {ramp_type(recorded), counter_type()};
    options.link.hoist = hoist;
    const std::vector<Images> frames = run_graph(kRamp, toy::one_quad(), options);
    EXPECT_EQ(recorded, hoist ? 1 : 5);
    for (size_t frame = 0; frame < 5; ++frame) {
      EXPECT_EQ(frames[frame].at("ramp").at(19, 8, 0, 0), 20) << frame;
      EXPECT_EQ(frames[frame].at("last").at(19, 8, 0, 0), 22) << frame;
      EXPECT_EQ(frames[frame].at("past").at(19, 8, 0, 0), frame == 0 ? 1 : 23) << frame;
    }
  }
}

TEST_F(HoistingTest, ItsTimeIsReportedWithTheFirstFrameAndRecorded) {
  PassRegistry registry;
  int recorded = 0;
  registry.add(ramp_type(recorded));
  registry.add(counter_type());
  Diagnostics diagnostics;
  const auto spec = parse_graph(kRamp, "ramp.json", diagnostics);
  ASSERT_TRUE(spec);
  const scene::Scene quad = toy::one_quad();
  const auto graph = link(*spec, registry, {}, link_environment(&quad), diagnostics);
  ASSERT_TRUE(graph);
  ShaderFolders shaders = default_shader_folders();
  shaders.sources.push_back(source_dir() / "tests/passes/shaders");
  ExecutorOptions options;
  options.shaders = shaders;
  Executor executor(device(), compile(*graph), quad, options);
  const auto names = [](const std::vector<PassTime>& times) {
    std::vector<std::string> result;
    for (const PassTime& time : times) {
      EXPECT_GE(time.milliseconds, 0) << time.pass;
      result.push_back(time.pass);
    }
    return result;
  };
  const FrameResult first = executor.run_frame(3);
  const FrameResult second = executor.run_frame(4);
  EXPECT_EQ(names(first.once_times), (std::vector<std::string>{"ramp", "next"}));
  EXPECT_EQ(names(first.times), (std::vector<std::string>{"past", "last"}));
  EXPECT_EQ(names(second.times), names(first.times));
  EXPECT_TRUE(second.once_times.empty());
  const nlohmann::ordered_json record = once_records(executor.plan(), first.once_times);
  ASSERT_EQ(record.size(), 2U);
  EXPECT_EQ(record[1]["pass"], "next");
  EXPECT_EQ(record[1]["type"], "test_counter");
  EXPECT_EQ(record[1]["reason"], "what it reads never changes: ramp.ramp");
  EXPECT_GE(record[1]["ms"].get<double>(), 0);
  EXPECT_EQ(pass_records(executor.plan(), {first.times, second.times}).size(), 2U);
}

/// A room of five walls with a light in it, and nothing that moves.
scene::Scene still_room() {
  scene::Material lamp = test::white_lambertian();
  lamp.emission = {4, 3, 2};
  return test::make_quad_scene({{{0, 0, 0}, {0, 0, 2}, {2, 0, 0}, 0},
                                {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, 0},
                                {{0, 0, 0}, {0, 2, 0}, {0, 0, 2}, 0},
                                {{2, 0, 0}, {0, 0, 2}, {0, 2, 0}, 0},
                                {{0.7f, 1.9f, 0.7f}, {0.6f, 0, 0}, {0, 0, 0.6f}, 1}},
                               {test::white_lambertian(), lamp}, test::look_at({1, 1, 4}, {1, 1, 0}, 0.9f));
}

std::string small_paper() {
  nlohmann::ordered_json graph = nlohmann::ordered_json::parse(read_text_file(source_dir() / "graphs/paper.json"));
  graph["view"] = {{"width", 40}, {"height", 30}};
  graph["trace"] = {{"width", 20}, {"height", 15}};
  graph["params"]["resolution"] = 24;
  return graph.dump();
}

std::vector<std::string> hoisted(const std::string& text, const scene::Scene& scene) {
  PassRegistry registry;
  passes::register_builtin_passes(registry);
  Diagnostics diagnostics;
  const auto spec = parse_graph(text, "paper.json", diagnostics);
  const auto graph = link(spec.value(), registry, {}, link_environment(&scene), diagnostics);
  std::vector<std::string> names;
  for (const GraphPass& pass : graph.value().passes)
    if (!pass.once.empty()) names.push_back(pass.name);
  return names;
}

/// Outputs and all values, over several frames, with and without hoisting, watched and not.
void expect_same_bits(const scene::Scene& scene, uint32_t frames) {
  GraphRunOptions options;
  options.frames = frames;
  options.link.hoist = false;
  options.capture = {"*"};
  const std::vector<Images> every_frame = run_graph(small_paper(), scene, options);
  options.link.hoist = true;
  const std::vector<Images> watched = run_graph(small_paper(), scene, options);
  options.capture.clear();
  const std::vector<Images> plain = run_graph(small_paper(), scene, options);
  for (size_t frame = 0; frame < frames; ++frame) {
    EXPECT_EQ(plain[frame].size(), 2U);
    EXPECT_EQ(watched[frame].size(), every_frame[frame].size());
    for (const std::vector<Images>* run : {&watched, &plain})
      for (const auto& [name, image] : run->at(frame))
        EXPECT_TRUE(image.texels == every_frame[frame].at(name).texels) << name << " in frame " << frame;
  }
  const auto& picture = every_frame.back().at("radiance");
  EXPECT_GT(picture.at(20, 15, 0, 0), 0) << "a black picture is the same in any case";
}

TEST_F(HoistingTest, AStillSceneGivesTheSameBits) {
  EXPECT_EQ(hoisted(small_paper(), still_room()), (std::vector<std::string>{"voxelize_static", "distance"}));
  expect_same_bits(still_room(), 4);
}

TEST_F(HoistingTest, ADynamicSceneGivesTheSameBits) {
  const scene::Scene atrium = scene::load_scene(source_dir() / "samples/scenes/atrium.scene.json");
  EXPECT_EQ(hoisted(small_paper(), atrium), std::vector<std::string>{"voxelize_static"});
  expect_same_bits(atrium, 4);
}

}  // namespace
}  // namespace lightloom::run
