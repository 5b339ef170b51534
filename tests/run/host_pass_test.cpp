// Passes that run on the host: between passes of the device, hoisted, with histories, constants and volumes, watched or
// not, and held to what they declare.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <functional>

#include "framework/base/error.hpp"
#include "framework/graph/graph_spec.hpp"
#include "framework/run/compile_graph.hpp"
#include "framework/run/executor.hpp"
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

std::vector<float> floats_of(const HostInput& input) {
  std::vector<float> values(input.texels.size() / sizeof(float));
  std::memcpy(values.data(), input.texels.data(), input.texels.size());
  return values;
}

void store(const HostOutput& output, const std::vector<float>& values) {
  ASSERT_EQ(values.size() * sizeof(float), output.texels.size());
  std::memcpy(output.texels.data(), values.data(), output.texels.size());
}

Port host_port(const std::string& name, Direction direction) {
  Port port = image_port(name, direction);
  port.access = direction == Direction::in ? Access::transfer_read : Access::transfer_write;
  return port;
}

PassType host_type(const std::string& name, std::vector<Port> ports, std::function<void(HostContext&)> host) {
  PassType type;
  type.name = name;
  type.doc = "For tests.";
  type.ports = std::move(ports);
  type.host = std::move(host);
  return type;
}

/// factor * x, and how often it ran.
PassType double_type(int& calls) {
  PassType type = host_type("host_double", {host_port("x", Direction::in), host_port("y", Direction::out)},
                            [&calls](HostContext& context) {
                              ++calls;
                              std::vector<float> values = floats_of(context.input("x", ""));
                              for (float& value : values) value *= static_cast<float>(context.params().real("factor"));
                              store(context.output("y", ""), values);
                            });
  type.params = {{"factor", ParamType::real, 2.0, {}, {}, {}, "", ""}};
  return type;
}

PassType ramp_type() {
  return one_shader_type("test_ramp", {image_port("ramp", Direction::out)}, "test_ramp.comp", "ramp");
}

PassType counter_type() {
  PassType type =
      one_shader_type("test_counter", {image_port("previous", Direction::in), image_port("count", Direction::out)},
                      "test_counter.comp", "count");
  type.ports[1].bypass = Bypass{"", {5, 0, 0, 0}};
  type.params = {{"start", ParamType::real, 0.0, {}, {}, {}, "", ""}};
  return type;
}

std::string graph_text(const std::string& passes, const std::string& outputs) {
  return R"({ "lightloom": 1, "name": "host", "view": { "width": 7, "height": 5 },
              "trace": { "width": 7, "height": 5 }, "passes": {)" +
         passes + R"(}, "outputs": {)" + outputs + "} }";
}

/// ramp (device, once) -> twice (host, once) -> sum (device, with a history) -> last (host, every frame)
const std::string kSandwich = graph_text(R"(
    "ramp": { "type": "test_ramp" },
    "twice": { "type": "host_double", "in": { "x": "ramp.ramp" } },
    "next": { "type": "test_counter", "in": { "previous": "twice.y" } },
    "past": { "type": "test_counter", "in": { "previous": "last.y@1" } },
    "last": { "type": "host_double", "in": { "x": "next.count" }, "params": { "factor": 10 } })",
                                         R"("twice": "twice.y", "past": "past.count", "last": "last.y")");

class HostPassTest : public test::DeviceTest {
 protected:
  GraphRunOptions options(uint32_t frames = 1) {
    GraphRunOptions result;
    result.frames = frames;
    result.extra_types = {double_type(calls), ramp_type(), counter_type()};
    return result;
  }
  int calls = 0;
};

TEST_F(HostPassTest, StandsBetweenPassesOfTheDevice) {
  const std::vector<Images> frames = run_graph(kSandwich, one_quad(), options(3));
  for (size_t frame = 0; frame < frames.size(); ++frame)
    for (uint32_t y = 0; y < 5; ++y)
      for (uint32_t x = 0; x < 7; ++x) {
        ASSERT_EQ(frames[frame].at("twice").at(x, y, 0, 0), 2.0 * (x + 1)) << frame;
        ASSERT_EQ(frames[frame].at("last").at(x, y, 0, 0), 10 * (2.0 * (x + 1) + 1)) << frame;
        ASSERT_EQ(frames[frame].at("past").at(x, y, 0, 0), frame == 0 ? 1 : 10 * (2.0 * (x + 1) + 1) + 1) << frame;
      }
}

TEST_F(HostPassTest, IsHoistedLikeAnyOther) {
  GraphRunOptions hoisted = options(4);
  const std::vector<Images> once = run_graph(kSandwich, one_quad(), hoisted);
  EXPECT_EQ(calls, 1 + 4) << "'twice' once, 'last', whose history is read, in every frame";
  calls = 0;
  hoisted.link.hoist = false;
  const std::vector<Images> each = run_graph(kSandwich, one_quad(), hoisted);
  EXPECT_EQ(calls, 4 + 4);
  for (size_t frame = 0; frame < 4; ++frame)
    for (const auto& [name, image] : once[frame]) EXPECT_EQ(image.texels, each[frame].at(name).texels) << name;
}

TEST_F(HostPassTest, CapturingChangesNothing) {
  GraphRunOptions watched = options(3);
  watched.capture = {"*"};
  const std::vector<Images> plain = run_graph(kSandwich, one_quad(), options(3));
  const std::vector<Images> captured = run_graph(kSandwich, one_quad(), watched);
  for (size_t frame = 0; frame < 3; ++frame) {
    for (const auto& [name, image] : plain[frame]) EXPECT_EQ(image.texels, captured[frame].at(name).texels) << name;
    EXPECT_EQ(captured[frame].at("last.y").texels, plain[frame].at("last").texels);
    EXPECT_EQ(captured[frame].at("twice.y").texels, plain[frame].at("twice").texels);
  }
}

TEST_F(HostPassTest, ReadsTheConstantOfADisabledPass) {
  GraphRunOptions disabled = options(2);
  disabled.link.disables = {"next"};
  for (const Images& images : run_graph(kSandwich, one_quad(), disabled))
    EXPECT_EQ(images.at("last").at(6, 4, 0, 0), 50);
}

TEST_F(HostPassTest, ReadsItsOwnPast) {
  const auto add_one = [](HostContext& context) {
    std::vector<float> values = floats_of(context.input("past", ""));
    for (float& value : values) value += 1;
    store(context.output("sum", ""), values);
  };
  GraphRunOptions own;
  own.frames = 7;
  own.extra_types = {
      host_type("host_sum", {host_port("past", Direction::in), host_port("sum", Direction::out)}, add_one)};
  const std::vector<Images> frames =
      run_graph(graph_text(R"("sum": { "type": "host_sum", "in": { "past": "sum.sum@3" } })", R"("o": "sum.sum")"),
                one_quad(), own);
  for (size_t frame = 0; frame < 7; ++frame)
    EXPECT_EQ(frames[frame].at("o").at(3, 2, 0, 0), static_cast<double>(frame / 3 + 1)) << frame;
}

/// Bundles, formats that are not float, volumes: a host pass counts in all texels of a volume, the next sums them up.
TEST_F(HostPassTest, MovesVolumesAndBundlesOfAnyFormat) {
  Port volume = host_port("v", Direction::out);
  volume.bundle = "pair";
  volume.parts = {{"bytes", Format::rgba8_unorm, ""}, {"ids", Format::r32_uint, ""}};
  volume.dimension = Dimension::d3;
  volume.extent = ExtentRule::fixed;
  volume.fixed_extent = {3, 4, 5};
  const PassType count = host_type("host_count", {volume}, [](HostContext& context) {
    const HostOutput bytes = context.output("v", "bytes");
    const HostOutput ids = context.output("v", "ids");
    EXPECT_EQ(bytes.extent, (Extent3{3, 4, 5}));
    EXPECT_EQ(ids.format, Format::r32_uint);
    ASSERT_EQ(bytes.texels.size(), 240U);
    ASSERT_EQ(ids.texels.size(), 240U);
    for (size_t i = 0; i < 240; ++i) {
      EXPECT_EQ(bytes.texels[i], std::byte{0}) << "outputs start as zeros";
      bytes.texels[i] = static_cast<std::byte>(i);
    }
    for (uint32_t i = 0; i < 60; ++i) {
      const uint32_t id = 1000000 + i;
      std::memcpy(ids.texels.data() + i * sizeof id, &id, sizeof id);
    }
  });
  Port read = volume;
  read.direction = Direction::in;
  read.access = Access::transfer_read;
  read.extent = ExtentRule::any;
  const PassType sum = host_type("host_total", {read, host_port("total", Direction::out)}, [](HostContext& context) {
    EXPECT_EQ(context.input("v", "ids").extent, (Extent3{3, 4, 5}));
    double total = 0;
    for (const std::byte byte : context.input("v", "bytes").texels) total += static_cast<double>(byte);
    const std::span<const std::byte> ids = context.input("v", "ids").texels;
    uint32_t last = 0;
    std::memcpy(&last, ids.data() + 59 * sizeof last, sizeof last);
    std::vector<float> values(35, static_cast<float>(total));
    values[0] = static_cast<float>(last);
    store(context.output("total", ""), values);
  });
  GraphRunOptions two;
  two.extra_types = {count, sum};
  const Images images = run_graph(graph_text(R"("c": { "type": "host_count" },
                                                "s": { "type": "host_total", "in": { "v": "c.v" } })",
                                             R"("o": "s.total")"),
                                  one_quad(), two)
                            .front();
  EXPECT_EQ(images.at("o").at(1, 0, 0, 0), 239 * 120);
  EXPECT_EQ(images.at("o").at(0, 0, 0, 0), 1000059);
}

/// What a run with this one host pass throws; empty if it runs.
std::string error_of(PassType type) {
  GraphRunOptions alone;
  alone.extra_types = {std::move(type)};
  try {
    static_cast<void>(run_graph(graph_text(R"("p": { "type": "host_probe" })", R"("o": "p.y")"), one_quad(), alone));
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

PassType probe(std::function<void(HostContext&)> host) {
  Port guide = host_port("guide", Direction::in);
  guide.optional = true;
  return host_type("host_probe", {guide, host_port("y", Direction::out), host_port("spare", Direction::out)},
                   std::move(host));
}

TEST_F(HostPassTest, IsHeldToWhatItDeclares) {
  const auto text = [](const std::function<void(HostContext&)>& host) { return error_of(probe(host)); };
  EXPECT_EQ(text([](HostContext& context) {
              EXPECT_FALSE(context.connected("guide"));
              EXPECT_TRUE(context.wanted("y"));
              EXPECT_FALSE(context.wanted("spare"));
              EXPECT_EQ(context.output("spare", "").texels.size(), context.output("y", "").texels.size());
            }),
            "");
  EXPECT_EQ(text([](HostContext& context) { static_cast<void>(context.input("guide", "")); }),
            "pass 'p' (host_probe) has no connected input 'guide'");
  EXPECT_EQ(text([](HostContext& context) { static_cast<void>(context.output("y", "part")); }),
            "pass 'p' (host_probe) has no output 'y.part'");
  EXPECT_EQ(text([](HostContext& context) { static_cast<void>(context.scene()); }),
            "pass 'p' (host_probe) reads the scene, which its type does not declare");
}

TEST_F(HostPassTest, SeesOnlyWhatItDeclaresOfTheFrame) {
  const auto seen = [](FrameState reads) {
    std::vector<scene::FrameScene> frames;
    PassType type = probe([&frames](HostContext& context) { frames.push_back(context.scene()); });
    type.reads = reads;
    GraphRunOptions alone;
    alone.extra_types = {type};
    alone.frames = 3;
    alone.seed = 9;
    static_cast<void>(run_graph(graph_text(R"("p": { "type": "host_probe" })", R"("o": "p.y")"), one_quad(), alone));
    return frames;
  };
  const auto all = seen(FrameState::camera | FrameState::time | FrameState::seed | FrameState::static_geometry);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[2].frame, 2U);
  EXPECT_EQ(all[2].seed, 9U);
  EXPECT_DOUBLE_EQ(all[2].time, 2 / 30.0);
  EXPECT_EQ(all[2].camera.name, "test");
  const auto timeless = seen(FrameState::lights);
  ASSERT_EQ(timeless.size(), 3U);
  EXPECT_EQ(timeless[2].frame, 0U);
  EXPECT_EQ(timeless[2].seed, 0U);
  EXPECT_EQ(timeless[2].time, 0);
  EXPECT_EQ(seen(FrameState::materials).size(), 1U) << "what never changes is read once";
}

/// An executor of a graph that must link, for what run_graph does not show.
Executor make_executor(gpu::Device& device, const std::string& text, const PassRegistry& registry,
                       const scene::Scene& scene, const std::shared_ptr<SceneMemo>& memo) {
  Diagnostics diagnostics;
  const auto spec = parse_graph(text, "host.json", diagnostics);
  const auto graph = link(spec.value(), registry, {}, link_environment(&scene), diagnostics);
  ExecutorOptions options;
  options.shaders = default_shader_folders();
  options.shaders.sources.push_back(source_dir() / "tests/passes/shaders");
  options.memo = memo;
  return {device, compile(graph.value()), scene, options};
}

TEST_F(HostPassTest, WhatItDerivesFromTheSceneIsKeptAndShared) {
  int made = 0;
  PassType type = probe([&made](HostContext& context) {
    const auto triangles = context.derived<size_t>([&] {
      ++made;
      return context.scene().scene->triangles.size();
    });
    EXPECT_EQ(triangles, 2U);
    const auto& cubes = context.derived<std::array<int, 3>>([] { return std::array<int, 3>{1, 8, 27}; });
    EXPECT_EQ(cubes[2], 27);
  });
  type.reads = FrameState::static_geometry | FrameState::time;
  PassRegistry registry;
  registry.add(type);
  const scene::Scene scene = one_quad();
  const std::string text = graph_text(R"("p": { "type": "host_probe" })", R"("o": "p.y")");
  const auto memo = std::make_shared<SceneMemo>();
  for (int executors = 0; executors < 2; ++executors) {
    Executor executor = make_executor(device(), text, registry, scene, memo);
    for (uint32_t frame = 0; frame < 3; ++frame) static_cast<void>(executor.run_frame(frame));
  }
  EXPECT_EQ(made, 1);
  Executor alone = make_executor(device(), text, registry, scene, nullptr);
  static_cast<void>(alone.run_frame(0));
  EXPECT_EQ(made, 2);
}

TEST_F(HostPassTest, IsTimedByTheHostsClock) {
  PassRegistry registry;
  registry.add(double_type(calls));
  registry.add(ramp_type());
  PassType slow = probe([](HostContext& context) {
    const auto start = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() - start < std::chrono::milliseconds(30)) {
    }
    static_cast<void>(context.scene());
  });
  slow.reads = FrameState::time;
  registry.add(slow);
  const scene::Scene scene = one_quad();
  Executor executor = make_executor(device(),
                                    graph_text(R"("p": { "type": "host_probe" }, "r": { "type": "test_ramp" },
                    "d": { "type": "host_double", "in": { "x": "r.ramp" } })",
                                               R"("o": "p.y", "q": "d.y")"),
                                    registry, scene, nullptr);
  const FrameResult first = executor.run_frame(0);
  ASSERT_EQ(first.times.size(), 1U);
  EXPECT_EQ(first.times[0].pass, "p");
  EXPECT_GE(first.times[0].milliseconds, 30);
  ASSERT_EQ(first.once_times.size(), 2U);
  EXPECT_EQ(first.once_times[1].pass, "d");
  EXPECT_GE(first.once_times[1].milliseconds, 0);
  EXPECT_LT(first.once_times[1].milliseconds, first.times[0].milliseconds);
}

TEST_F(HostPassTest, AFailureLeavesTheExecutorUsable) {
  bool fail = true;
  PassType type = probe([&fail](HostContext& context) {
    static_cast<void>(context.scene());
    if (fail) throw Error(ExitCode::run_failed, "no luck");
    store(context.output("y", ""), std::vector<float>(35, 4.0f));
  });
  type.reads = FrameState::time;
  PassRegistry registry;
  registry.add(type);
  const scene::Scene scene = one_quad();
  Executor executor = make_executor(device(), graph_text(R"("p": { "type": "host_probe" })", R"("o": "p.y")"), registry,
                                    scene, nullptr);
  EXPECT_THROW(static_cast<void>(executor.run_frame(0)), Error);
  fail = false;
  EXPECT_EQ(executor.run_frame(0).outputs.at(0).image.at(6, 4, 0, 0), 4);
}

}  // namespace
}  // namespace lightloom::run
