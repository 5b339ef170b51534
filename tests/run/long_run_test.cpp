// Thousands of frames: nothing may pile up. The device's memory is the host's here, so resident pages tell of both.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <fstream>
#include <optional>
#include <string>

#include "framework/graph/graph_spec.hpp"
#include "framework/graph/link.hpp"
#include "framework/run/compile_graph.hpp"
#include "framework/run/executor.hpp"
#include "tests/run/integer_graph.hpp"
#include "tests/run/toy_types.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::run {
namespace {

/// [bytes]
int64_t resident_memory() {
  std::ifstream file("/proc/self/statm");
  int64_t pages = 0;
  int64_t resident = 0;
  file >> pages >> resident;
  return resident * ::sysconf(_SC_PAGESIZE);
}

std::optional<Plan> plan_of(const std::string& text, const PassRegistry& registry, const scene::Scene& scene) {
  Diagnostics diagnostics;
  const std::optional<GraphSpec> spec = parse_graph(text, "test.json", diagnostics);
  if (!spec) return std::nullopt;
  const std::optional<Graph> graph = link(*spec, registry, {}, link_environment(&scene), diagnostics);
  return graph ? std::optional(compile(*graph)) : std::nullopt;
}

void expect_flat_memory(uint32_t frames) {
  gpu::Device device({.name = "", .validate = false});
  const scene::Scene scene = toy::one_quad();
  PassRegistry registry;
  for (const PassType& type : toy::integer_types()) registry.add(type);
  std::optional<Plan> plan = plan_of(toy::IntegerGraph(1, 12).text(), registry, scene);
  ASSERT_TRUE(plan);
  ShaderFolders shaders = default_shader_folders();
  shaders.sources.push_back(source_dir() / "tests/run/shaders");
  Executor executor(device, std::move(*plan), scene, {.shaders = shaders, .camera = {}});
  uint32_t frame = 0;
  for (; frame < frames / 10; ++frame) static_cast<void>(executor.run_frame(frame));
  const int64_t warm = resident_memory();
  ASSERT_GT(warm, 0);
  for (; frame < frames; ++frame) static_cast<void>(executor.run_frame(frame));
  const int64_t growth = resident_memory() - warm;
  testing::Test::RecordProperty("growth_bytes", std::to_string(growth));
  // The allocator's own grain; a leak of one descriptor pool a frame would be a hundred times that.
  EXPECT_LT(growth, int64_t{2} << 20) << "after " << frames << " frames";
}

TEST(LongRun, AThousandFramesKeepMemoryFlat) {
  expect_flat_memory(1000);
}

// A test of its own in tests/CMakeLists.txt, with the label `slow`.
TEST(LongRun, DISABLED_TenThousandFramesKeepMemoryFlat) {
  expect_flat_memory(10000);
}

}  // namespace
}  // namespace lightloom::run
