#include "tests/support/graph_runner.hpp"

#include <stdexcept>

#include "framework/base/error.hpp"
#include "framework/run/shader_folders.hpp"
#include "passes/registry.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::test {

void visit_frames(std::string_view graph_json, const scene::Scene& scene, const GraphRunOptions& options,
                  const FrameVisitor& visit) {
  PassRegistry registry;
  passes::register_builtin_passes(registry);
  for (const PassType& type : options.extra_types) registry.add(type);
  run::ShaderFolders shaders = run::default_shader_folders();
  shaders.sources.push_back(source_dir() / "tests/passes/shaders");
  stability::Lab(shared_device(), registry, shaders).visit(graph_json, scene, options, visit);
}

std::vector<Images> run_graph(std::string_view graph_json, const scene::Scene& scene, const GraphRunOptions& options) {
  std::vector<Images> frames;
  visit_frames(graph_json, scene, options, [&](uint32_t, Images images) { frames.push_back(std::move(images)); });
  return frames;
}

}  // namespace lightloom::test
