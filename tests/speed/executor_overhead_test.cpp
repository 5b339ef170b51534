// What the executor costs the host for each pass and frame, beyond the calls of Vulkan that a program written by hand
// would make for the same. Labelled slow: a machine that is busy with other things fails it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <string>

#include "framework/gpu/command_session.hpp"
#include "framework/gpu/descriptors.hpp"
#include "framework/gpu/transfer.hpp"
#include "framework/graph/graph_spec.hpp"
#include "framework/graph/link.hpp"
#include "framework/run/barriers.hpp"
#include "framework/run/compile_graph.hpp"
#include "framework/run/executor.hpp"
#include "framework/scene/scene.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::run {
namespace {

constexpr uint32_t kPasses = 200;
constexpr int kFrames = 60;

Port image_port(const std::string& name, Direction direction) {
  Port port;
  port.name = name;
  port.direction = direction;
  port.parts = {{"", Format::r32_sfloat, ""}};
  port.extent = direction == Direction::in ? ExtentRule::any : ExtentRule::fixed;
  port.access = direction == Direction::in ? Access::compute_sampled_read : Access::compute_storage_write;
  return port;
}

PassRegistry registry() {
  PassRegistry types;
  PassType source;
  source.name = "source";
  source.doc = "For tests.";
  source.reads = FrameState::time;
  source.ports = {image_port("a", Direction::out)};
  source.record = [](PassContext& context) { context.clear("a", {0.5f, 0, 0, 0}); };
  types.add(source);
  PassType step;
  step.name = "step";
  step.doc = "For tests.";
  step.ports = {image_port("x", Direction::in), image_port("a", Direction::out)};
  step.params = {{"gain", ParamType::real, 1.0, 0, 2, {}, "", "factor"}};
  step.record = [](PassContext& context) { context.dispatch({"speed_step.comp", {1, 1, 1}, {}}); };
  types.add(step);
  return types;
}

std::string chain() {
  std::string text = R"({"lightloom": 1, "passes": {"p0": {"type": "source"})";
  for (uint32_t i = 1; i <= kPasses; ++i)
    text += ", \"p" + std::to_string(i) + R"(": {"type": "step", "in": {"x": "p)" + std::to_string(i - 1) + ".a\"}}";
  return text + R"(}, "outputs": {"o": "p)" + std::to_string(kPasses) + ".a\"}}";
}

/// Median host time of `work` [µs].
template <class Work, class Rest>
double median_microseconds(Work work, Rest rest) {
  std::vector<double> times;
  for (int i = 0; i < kFrames; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    times.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
    rest();
  }
  std::nth_element(times.begin(), times.begin() + kFrames / 2, times.end());
  return times[kFrames / 2];
}

/// The same commands by hand: names, values and sets are found once, and each frame only records.
double by_hand(gpu::Device& device, const ShaderFolders& folders) {
  const std::shared_ptr<ShaderLibrary> library = make_library(device, folders);
  const gpu::Pipeline& pipeline = library->pipelines().compute(library->program({"speed_step.comp"}), {});
  const gpu::Image image(device, {.format = VK_FORMAT_R32_SFLOAT,
                                  .extent = {1, 1, 1},
                                  .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT,
                                  .name = "texel"});
  gpu::DescriptorAllocator descriptors(device);
  const VkDescriptorSet set =
      descriptors.allocate(pipeline, {{"x", gpu::resource(image)}, {"out_a", gpu::resource(image)}});
  const std::array<std::byte, 4> gain{};
  const std::array dependency{Dependency{Access::compute_storage_write, Access::compute_sampled_read}};
  return median_microseconds(
      [&] {
        gpu::CommandSession session(device);
        for (uint32_t i = 0; i < kPasses; ++i) {
          record_dependencies(session.get(), dependency);
          pipeline.bind(session.get(), set, gain);
          vkCmdDispatch(session.get(), 1, 1, 1);
        }
        session.start();
      },
      [&] { device.wait_commands(); });
}

TEST(ExecutorOverhead, IsBelowFiveMicrosecondsAPassAndFrame) {
  gpu::Device device(gpu::DeviceOptions{});
  ShaderFolders folders = default_shader_folders();
  folders.sources.push_back(source_dir() / "tests/speed/shaders");
  const PassRegistry types = registry();
  Diagnostics diagnostics;
  const std::optional<GraphSpec> spec = parse_graph(chain(), "chain.json", diagnostics);
  ASSERT_TRUE(spec);
  const std::optional<Graph> graph = link(*spec, types, {}, link_environment(nullptr), diagnostics);
  ASSERT_TRUE(graph);
  scene::Scene scene;
  scene.cameras.emplace_back();
  Executor executor(device, compile(*graph), scene, {.shaders = folders, .camera = {}, .time_passes = false});
  uint32_t frame = 0;
  static_cast<void>(executor.run_frame(frame++));
  const double framework = median_microseconds([&] { executor.start_frame(frame++, {.outputs = false}); },
                                               [&] { static_cast<void>(executor.finish_frame()); });
  const double bare = by_hand(device, folders);
  const double overhead = (framework - bare) / kPasses;
  std::printf("%u passes: %.0f us of the host a frame, %.0f us by hand: %.2f us a pass more\n", kPasses, framework,
              bare, overhead);
  EXPECT_LT(overhead, 5.0);
}

}  // namespace
}  // namespace lightloom::run
