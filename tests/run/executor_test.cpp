#include "framework/run/executor.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "framework/base/error.hpp"
#include "framework/graph/graph_spec.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/graph_runner.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::run {
namespace {

using test::GraphRunOptions;
using test::Images;

Port image_port(const std::string& name, Direction direction) {
  Port port;
  port.name = name;
  port.direction = direction;
  port.parts = {{"", Format::r32_sfloat, ""}};
  port.extent = direction == Direction::out ? ExtentRule::trace : ExtentRule::any;
  port.access = direction == Direction::out ? Access::compute_storage_write : Access::compute_sampled_read;
  return port;
}

PassType one_shader_type(const std::string& name, std::vector<Port> ports, const std::string& shader,
                         const std::string& output) {
  PassType type;
  type.name = name;
  type.doc = "For tests.";
  type.ports = std::move(ports);
  type.record = [shader, output](PassContext& context) {
    context.dispatch({shader, context.output_extent(output), {}});
  };
  return type;
}

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

scene::Scene one_quad() {
  return test::make_quad_scene({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0}}, {},
                               test::look_at({0.5f, 0.5f, 2}, {0.5f, 0.5f, 0}, 0.8f));
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
