#pragma once

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/graph/graph_spec.hpp"
#include "framework/run/compile_graph.hpp"
#include "framework/run/executor.hpp"
#include "passes/registry.hpp"
#include "tests/run/toy_types.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::run::toy {

/// A graph of toy types, compiled with scans.
struct ObservedGraph {
  ObservedGraph(const std::string& text, const std::vector<PassType>& types, const scene::Scene& scene,
                const LinkOptions& link_options = {}, bool scan = true) {
    passes::register_builtin_passes(registry);
    for (const PassType& type : types) registry.add(type);
    Diagnostics diagnostics;
    const auto spec = parse_graph(text, "test.json", diagnostics);
    const auto graph = spec ? link(*spec, registry, link_options, link_environment(&scene), diagnostics) : std::nullopt;
    for (const Diagnostic& diagnostic : diagnostics.all()) ADD_FAILURE() << format_diagnostic(diagnostic);
    if (!graph) throw std::runtime_error("the test's graph does not link");
    CompileOptions options;
    options.scan = scan;
    plan = compile(*graph, options);
  }

  [[nodiscard]] ValueId id(const std::string& name) const {
    for (ValueId value = 0; value < plan.graph.values.size(); ++value)
      if (value_name(plan.graph.values[value]) == name) return value;
    throw std::runtime_error("no value " + name);
  }

  PassRegistry registry;
  Plan plan;
};

inline ExecutorOptions observed_options(std::optional<PoisonTone> poison = std::nullopt) {
  ExecutorOptions options;
  options.shaders = default_shader_folders();
  options.shaders.sources.push_back(source_dir() / "tests/passes/shaders");
  options.poison = poison;
  return options;
}

inline std::vector<FrameResult> run_frames(const Plan& plan, const scene::Scene& scene, uint32_t frames,
                                           const ExecutorOptions& options) {
  Executor executor(test::shared_device(), plan, scene, options);
  std::vector<FrameResult> results;
  for (uint32_t frame = 0; frame < frames; ++frame) results.push_back(executor.run_frame(frame));
  return results;
}

inline const ScannedValue* find_scan(const FrameResult& result, ValueId value) {
  for (const ScannedValue& seen : result.scanned)
    if (seen.value == value) return &seen;
  return nullptr;
}

/// Do two runs agree in every bit of what they gave to the host?
inline void expect_same_images(const std::vector<FrameResult>& one, const std::vector<FrameResult>& other) {
  ASSERT_EQ(one.size(), other.size());
  for (size_t frame = 0; frame < one.size(); ++frame) {
    ASSERT_EQ(one[frame].outputs.size(), other[frame].outputs.size());
    for (size_t i = 0; i < one[frame].outputs.size(); ++i)
      EXPECT_TRUE(one[frame].outputs[i].image.texels == other[frame].outputs[i].image.texels)
          << one[frame].outputs[i].name << " in frame " << frame;
    ASSERT_EQ(one[frame].captures.size(), other[frame].captures.size());
    for (size_t i = 0; i < one[frame].captures.size(); ++i)
      EXPECT_TRUE(one[frame].captures[i].image.texels == other[frame].captures[i].image.texels)
          << one[frame].captures[i].name << " in frame " << frame;
  }
}

}  // namespace lightloom::run::toy
