#pragma once

#include <filesystem>
#include <optional>

#include "framework/base/diagnostics.hpp"
#include "framework/base/file_watch.hpp"
#include "framework/graph/graph_spec.hpp"
#include "framework/graph/pass_type.hpp"
#include "framework/run/shader_folders.hpp"

namespace lightloom::run {

/// Gives every node of type `compute` its pass type (compute_type.hpp): finds its shader beside the graph's file, then
/// in the shader folders, compiles it and reads its interface. What does not compile or fit is reported at the node,
/// with file and line of the shader. Adds what was read and looked for to `files_read`, if that is given.
void make_compute_types(GraphSpec& spec, const PassRegistry& registry, const ShaderFolders& shaders,
                        Diagnostics& diagnostics, FileContents* files_read = nullptr);

/// The text of a graph file, ready to be linked: parsed, its compute types made. `file` is its name, beside which
/// shaders are looked for. Without `shaders`, those of default_shader_folders. What is wrong is reported; empty where
/// parse_graph gives nothing.
[[nodiscard]] std::optional<GraphSpec> parse_graph_text(const std::string& text, const std::filesystem::path& file,
                                                        const PassRegistry& registry,
                                                        const std::optional<ShaderFolders>& shaders,
                                                        Diagnostics& diagnostics, FileContents* files_read = nullptr);

/// The same of a file. Throws Error(invalid_input) when it cannot be read.
[[nodiscard]] std::optional<GraphSpec> read_graph(const std::filesystem::path& file, const PassRegistry& registry,
                                                  const std::optional<ShaderFolders>& shaders,
                                                  Diagnostics& diagnostics);

}  // namespace lightloom::run
