#include "framework/run/compile_graph.hpp"

#include "framework/base/file.hpp"
#include "framework/run/compute_types.hpp"
#include "framework/run/grid.hpp"

namespace lightloom::run {

LinkEnvironment link_environment(const scene::Scene* scene) {
  LinkEnvironment environment;
  const scene::Bounds bounds = scene != nullptr ? scene->bounds : scene::Bounds{glm::vec3(0), glm::vec3(1)};
  environment.grid_extent = [bounds](int64_t resolution) {
    return grid_extent(bounds.min, bounds.max, static_cast<uint32_t>(resolution));
  };
  environment.scene_features = (scene != nullptr ? scene->features : scene::Features{}).named();
  if (scene == nullptr)
    for (auto& [name, present] : environment.scene_features) present = true;
  if (scene != nullptr && scene->static_triangle_count == scene->triangles.size())
    environment.changing = FrameState::camera | FrameState::time | FrameState::seed | FrameState::lights;
  return environment;
}

std::optional<Graph> link_text(const std::string& text, const std::filesystem::path& file, const PassRegistry& registry,
                               const LinkOptions& options, const scene::Scene* scene, Diagnostics& diagnostics,
                               const std::optional<ShaderFolders>& shaders, FileContents* files_read) {
  const std::optional<GraphSpec> spec = parse_graph_text(text, file, registry, shaders, diagnostics, files_read);
  if (!spec) return std::nullopt;
  return link(*spec, registry, options, link_environment(scene), diagnostics);
}

std::optional<Plan> compile_graph(const std::filesystem::path& file, const PassRegistry& registry,
                                  const LinkOptions& options, const scene::Scene* scene, Diagnostics& diagnostics,
                                  const CompileOptions& compile_options, const std::optional<ShaderFolders>& shaders) {
  const std::optional<Graph> graph =
      link_text(read_text_file(file), file, registry, options, scene, diagnostics, shaders);
  if (!graph) return std::nullopt;
  return compile(*graph, compile_options);
}

}  // namespace lightloom::run
