#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "framework/run/compile_graph.hpp"
#include "framework/run/executor.hpp"
#include "passes/registry.hpp"
#include "tests/run/toy_types.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::run::toy {

/// A folder of one's own with graph and shader files, and what comes of them.
class ComputeFolder : public test::DeviceTest {
 protected:
  void SetUp() override {
    DeviceTest::SetUp();
    passes::register_builtin_passes(registry_);
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("lightloom-compute-" + std::string(test->name()) + "-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override {
    std::filesystem::remove_all(folder_);
    DeviceTest::TearDown();
  }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

  /// A shader that stores `value`, an expression of `pixel`, into out_value; `declarations` come before it.
  void write_shader(const std::string& name, const std::string& declarations, const std::string& value) const {
    write(name, "#version 460\nlayout(local_size_x = 8, local_size_y = 8) in;\n" + declarations +
                    "\nvoid main() {\n  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);\n"
                    "  if (all(lessThan(pixel, imageSize(out_value).xy))) imageStore(out_value, pixel, " +
                    value + ");\n}\n");
  }

  /// The passes and outputs of a graph of 20 x 9 pixels.
  std::optional<Plan> plan(const std::string& passes, const std::string& outputs, const LinkOptions& options = {}) {
    write("graph.json", R"({ "lightloom": 1, "name": "compute", "view": { "width": 20, "height": 9 },
  "trace": { "width": 10, "height": 5 }, "params": { "level": 2, "flag": true },
  "passes": {)" + passes + "},\n \"outputs\": {" +
                            outputs + "} }");
    Diagnostics diagnostics;
    const scene::Scene scene = one_quad();
    std::optional<Plan> made = compile_graph(folder_ / "graph.json", registry_, options, &scene, diagnostics);
    errors_.clear();
    for (const Diagnostic& problem : diagnostics.sorted())
      if (problem.severity == Severity::error) errors_ += format_diagnostic(problem) + "\n";
    return made;
  }

  std::vector<FrameResult> frames(const Plan& made, uint32_t count) const {
    const scene::Scene scene = one_quad();
    Executor executor(device(), made, scene, {.shaders = default_shader_folders(), .camera = {}});
    std::vector<FrameResult> results;
    for (uint32_t i = 0; i < count; ++i) results.push_back(executor.run_frame(i));
    return results;
  }

  PassRegistry registry_;
  std::filesystem::path folder_;
  std::string errors_;  ///< of the last plan
};

inline const GraphPass& pass_named(const Plan& plan, const std::string& name) {
  for (const GraphPass& pass : plan.graph.passes)
    if (pass.name == name) return pass;
  throw std::out_of_range(name);
}

inline const image::HostImage& output_named(const FrameResult& frame, const std::string& name) {
  for (const NamedImage& output : frame.outputs)
    if (output.name == name) return output.image;
  throw std::out_of_range(name);
}

}  // namespace lightloom::run::toy
