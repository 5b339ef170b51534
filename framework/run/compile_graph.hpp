#pragma once

#include <filesystem>
#include <optional>

#include "framework/base/diagnostics.hpp"
#include "framework/base/file_watch.hpp"
#include "framework/graph/link.hpp"
#include "framework/graph/pass_type.hpp"
#include "framework/graph/plan.hpp"
#include "framework/run/shader_folders.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::run {

/// What a graph is linked against for this scene; without one, a unit cube that has every feature.
[[nodiscard]] LinkEnvironment link_environment(const scene::Scene* scene);

/// Parses and links the text of a graph file; `file` is its name, for messages and for shaders that lie beside it.
/// Others are looked for in `shaders`, without them in default_shader_folders. Empty if `diagnostics` has errors.
/// Adds what was read and looked for of the shaders to `files_read`, if that is given.
[[nodiscard]] std::optional<Graph> link_text(const std::string& text, const std::filesystem::path& file,
                                             const PassRegistry& registry, const LinkOptions& options,
                                             const scene::Scene* scene, Diagnostics& diagnostics,
                                             const std::optional<ShaderFolders>& shaders = {},
                                             FileContents* files_read = nullptr);

/// Reads, parses, links and compiles a graph file. Empty if `diagnostics` has errors. Throws Error(invalid_input) when
/// the file cannot be read.
[[nodiscard]] std::optional<Plan> compile_graph(const std::filesystem::path& file, const PassRegistry& registry,
                                                const LinkOptions& options, const scene::Scene* scene,
                                                Diagnostics& diagnostics, const CompileOptions& compile_options = {},
                                                const std::optional<ShaderFolders>& shaders = {});

}  // namespace lightloom::run
