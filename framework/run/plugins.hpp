#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "framework/graph/pass_type.hpp"
#include "framework/run/shader_folders.hpp"

namespace lightloom::run {

/// A shared library of pass types (framework/graph/plugin.hpp); stays loaded for as long as this lives, so it must
/// outlive the registry.
struct LoadedPlugin {
  std::filesystem::path file;
  std::string name;
  std::string version;
  std::filesystem::path shaders;  ///< folder beside it; empty if there is none
  std::shared_ptr<void> library;
};

/// Loads a plug-in and adds its pass types. Throws Error(invalid_input) for a file that cannot be loaded, is no
/// plug-in, was built against another interface, or whose pass types are refused; the registry is then as it was.
[[nodiscard]] LoadedPlugin load_plugin(const std::filesystem::path& file, PassRegistry& registry);

/// Where shaders are found with these plug-ins: default_shader_folders, then theirs.
[[nodiscard]] ShaderFolders shader_folders_with(const std::vector<LoadedPlugin>& plugins);

}  // namespace lightloom::run
