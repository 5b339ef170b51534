#include "framework/run/executor.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "framework/base/error.hpp"
#include "framework/graph/graph_spec.hpp"
#include "tests/run/toy_types.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/graph_runner.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::run {
namespace {

using test::GraphRunOptions;
using test::Images;
using toy::image_port;
using toy::one_quad;
using toy::one_shader_type;

PassType counter_type() {
  PassType type =
      one_shader_type("test_counter", {image_port("previous", Direction::in), image_port("count", Direction::out)},
                      "test_counter.comp", "count");
  type.ports[1].bypass = Bypass{"", {5, 0, 0, 0}};
  type.params = {{"start", ParamType::real, 0.0, {}, {}, {}, "", "added at each step"}};
  return type;
}

PassType trail_type() {
  Port trail = image_port("trail", Direction::in);
  trail.array = true;
  return one_shader_type("test_trail", {trail, image_port("ages", Direction::out)}, "test_trail.comp", "ages");
}

PassType optional_type() {
  Port guide = image_port("guide", Direction::in);
  guide.optional = true;
  return one_shader_type("test_optional", {guide, image_port("seen", Direction::out)}, "test_optional.comp", "seen");
}

constexpr const char* kCounter = R"({
  "lightloom": 1, "name": "counter",
  "view": { "width": 12, "height": 5 }, "trace": { "width": 12, "height": 5 },
  "passes": {
    "counter": { "type": "test_counter", "in": { "previous": "counter.count@1" } },
    "trail": { "type": "test_trail", "in": { "trail": "counter.count@2..4" } }
  },
  "outputs": { "count": "counter.count", "ages": "trail.ages" }
})";

class ExecutorTest : public test::DeviceTest {
 protected:
  static GraphRunOptions options(uint32_t frames) {
    GraphRunOptions result;
    result.frames = frames;
    result.extra_types = {counter_type(), trail_type(), optional_type()};
    return result;
  }
};

TEST_F(ExecutorTest, HistoryOfOneFrameCountsFrames) {
  const std::vector<Images> frames = run_graph(kCounter, one_quad(), options(7));
  for (size_t frame = 0; frame < frames.size(); ++frame)
    for (uint32_t y = 0; y < 5; ++y)
      for (uint32_t x = 0; x < 12; ++x)
        ASSERT_EQ(frames[frame].at("count").at(x, y, 0, 0), static_cast<double>(frame + 1));
}

TEST_F(ExecutorTest, ARangeSeesEachAgeAndZeroBeforeTheFirstFrame) {
  const std::vector<Images> frames = run_graph(kCounter, one_quad(), options(8));
  for (int frame = 0; frame < 8; ++frame)
    for (int offset = 0; offset < 3; ++offset) {
      const int age = 2 + offset;
      const double expected = std::max(0, frame + 1 - age);
      EXPECT_EQ(frames[static_cast<size_t>(frame)].at("ages").at(static_cast<uint32_t>(offset), 0, 0, 0), expected)
          << "frame " << frame << ", age " << age;
    }
}

TEST_F(ExecutorTest, CapturingChangesNothing) {
  GraphRunOptions watched = options(6);
  watched.capture = {"*"};
  const std::vector<Images> plain = run_graph(kCounter, one_quad(), options(6));
  const std::vector<Images> captured = run_graph(kCounter, one_quad(), watched);
  for (size_t frame = 0; frame < plain.size(); ++frame) {
    EXPECT_EQ(plain[frame].at("count").texels, captured[frame].at("count").texels);
    EXPECT_EQ(plain[frame].at("ages").texels, captured[frame].at("ages").texels);
    EXPECT_EQ(captured[frame].at("counter.count").texels, plain[frame].at("count").texels);
  }
}

TEST_F(ExecutorTest, ADisabledPassGivesItsConstant) {
  GraphRunOptions disabled = options(3);
  disabled.link.disables = {"counter"};
  const std::vector<Images> frames = run_graph(kCounter, one_quad(), disabled);
  EXPECT_EQ(frames[2].at("count").at(11, 4, 0, 0), 5.0);
  EXPECT_EQ(frames[2].at("ages").at(0, 0, 0, 0), 5.0) << "its history is the same constant";
}

TEST_F(ExecutorTest, ParamsReachTheShader) {
  GraphRunOptions set = options(2);
  set.link.sets = {{"counter.start", "0.5"}};
  EXPECT_EQ(run_graph(kCounter, one_quad(), set)[1].at("count").at(0, 0, 0, 0), 3.0);
}

TEST_F(ExecutorTest, AnOptionalInputMayBeLeftOut) {
  constexpr const char* kGraph = R"({
    "lightloom": 1, "name": "optional",
    "view": { "width": 4, "height": 4 }, "trace": { "width": 4, "height": 4 },
    "passes": {
      "counter": { "type": "test_counter", "in": { "previous": "counter.count@1" } },
      "without": { "type": "test_optional" },
      "with": { "type": "test_optional", "in": { "guide": "counter.count" } }
    },
    "outputs": { "without": "without.seen", "with": "with.seen" }
  })";
  const Images images = run_graph(kGraph, one_quad(), options(1)).front();
  EXPECT_EQ(images.at("without").at(3, 3, 0, 0), 0.0);
  EXPECT_EQ(images.at("with").at(3, 3, 0, 0), 2.0);
}

TEST_F(ExecutorTest, AShaderMayNotReadWhatItsPassTypeDoesNotDeclare) {
  GraphRunOptions sneaky = options(1);
  PassType type = counter_type();
  type.record = [](PassContext& context) {
    context.dispatch({"test_reads_materials.comp", context.output_extent("count"), {}});
  };
  sneaky.extra_types = {type, trail_type(), optional_type()};
  try {
    static_cast<void>(run_graph(kCounter, one_quad(), sneaky));
    FAIL() << "an undeclared read went unnoticed";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("MaterialBlock"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("counter"), std::string::npos) << error.what();
  }
}

/// The message of the error that a type made of this shader runs into; empty if it runs.
std::string error_of(const PassType& type, const LinkOptions& link) {
  GraphRunOptions options;
  options.extra_types = {type};
  options.link = link;
  try {
    static_cast<void>(run_graph(R"({ "lightloom": 1, "name": "reader",
      "view": { "width": 4, "height": 4 }, "trace": { "width": 4, "height": 4 },
      "passes": { "reader": { "type": "test_reader" } }, "outputs": { "o": "reader.)" +
                                    type.ports[0].name + "\" } }",
                                one_quad(), options));
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST_F(ExecutorTest, WhatAShaderMayReadDependsOnTheParams) {
  PassType type =
      one_shader_type("test_reader", {image_port("count", Direction::out)}, "test_reads_materials.comp", "count");
  type.params = {{"start", ParamType::real, 1.0, {}, {}, {}, "", ""},
                 {"coloured", ParamType::boolean, true, {}, {}, {}, "", ""}};
  type.reads = FrameState::materials;
  type.reads_with = [](const ParamSet& params) {
    return params.boolean("coloured") ? FrameState::materials : FrameState::none;
  };
  EXPECT_EQ(error_of(type, {}), "");
  LinkOptions plain;
  plain.sets = {{"reader.coloured", "false"}};
  EXPECT_NE(error_of(type, plain).find("MaterialBlock"), std::string::npos);
}

TEST_F(ExecutorTest, WhatChangesInTheFrameBlockMustBeDeclared) {
  PassType type = one_shader_type("test_reader", {image_port("ramp", Direction::out)}, "test_reads_frame.comp", "ramp");
  type.reads = FrameState::materials | FrameState::lights | FrameState::static_geometry;
  EXPECT_NE(error_of(type, {}).find("FrameBlock.ids"), std::string::npos);
  for (const FrameState state : {FrameState::time, FrameState::seed}) {
    type.reads = state;
    EXPECT_EQ(error_of(type, {}), "");
  }
}

TEST_F(ExecutorTest, AnOutputThatNobodyReadsIsNotWanted) {
  std::vector<bool> wanted;
  PassType type =
      one_shader_type("test_wanted", {image_port("main", Direction::out), image_port("extra", Direction::out)},
                      "test_wanted.comp", "main");
  type.reads = FrameState::camera;
  type.record = [&wanted, dispatch = type.record](PassContext& context) {
    EXPECT_TRUE(context.wanted("main"));
    wanted.push_back(context.wanted("extra"));
    dispatch(context);
  };
  constexpr const char* kGraph = R"({ "lightloom": 1, "name": "wanted",
      "view": { "width": 20, "height": 9 }, "trace": { "width": 20, "height": 9 },
      "passes": { "two": { "type": "test_wanted" } }, "outputs": { "main": "two.main" } })";
  GraphRunOptions options;
  options.frames = 2;
  options.extra_types = {type};
  const std::vector<Images> alone = run_graph(kGraph, one_quad(), options);
  options.capture = {"two.extra"};
  const std::vector<Images> watched = run_graph(kGraph, one_quad(), options);
  EXPECT_EQ(wanted, (std::vector<bool>{false, false, true, true}));
  for (size_t frame = 0; frame < 2; ++frame) {
    EXPECT_EQ(alone[frame].at("main").texels, watched[frame].at("main").texels);
    EXPECT_EQ(watched[frame].at("two.extra").at(19, 8, 0, 0), 2 * watched[frame].at("main").at(19, 8, 0, 0));
    EXPECT_GT(watched[frame].at("two.extra").at(0, 0, 0, 0), 0);
  }
}

TEST_F(ExecutorTest, TimesOfEveryPassAreReported) {
  PassRegistry registry;
  for (PassType type : {counter_type(), trail_type()}) registry.add(type);
  Diagnostics diagnostics;
  const auto spec = parse_graph(kCounter, "counter.json", diagnostics);
  ASSERT_TRUE(spec);
  const scene::Scene quad = one_quad();
  const auto graph = link(*spec, registry, {}, {}, diagnostics);
  ASSERT_TRUE(graph);
  ShaderFolders shaders = default_shader_folders();
  shaders.sources.push_back(source_dir() / "tests/passes/shaders");
  Executor executor(device(), compile(*graph), quad,
                    {.shaders = shaders, .camera = "", .seed = 0, .frames_per_second = 30});
  const FrameResult result = executor.run_frame(3);
  EXPECT_EQ(result.frame, 3u);
  ASSERT_EQ(result.times.size(), 2u);
  EXPECT_EQ(result.times[0].pass, "counter");
  EXPECT_EQ(result.times[1].pass, "trail");
  for (const PassTime& time : result.times) EXPECT_GE(time.milliseconds, 0) << time.pass;
}

TEST_F(ExecutorTest, AnUnknownCameraIsNamedWithThoseThereAre) {
  GraphRunOptions wrong = options(1);
  wrong.camera = "crane";
  try {
    static_cast<void>(run_graph(kCounter, one_quad(), wrong));
    FAIL() << "an unknown camera went unnoticed";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::invalid_input);
    EXPECT_NE((std::string(error.what()) + error.hint()).find("test"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace lightloom::run
