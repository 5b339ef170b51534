#pragma once

#include <filesystem>
#include <vector>

namespace lightloom::run {

/// Where shaders are found and where compiled ones are kept.
struct ShaderFolders {
  std::vector<std::filesystem::path> sources;  ///< searched in order, for shaders and for their includes
  std::filesystem::path cache;                 ///< of SPIR-V and pipelines; made if missing; empty: none
};

/// Sources: $LIGHTLOOM_SHADERS if set, else `shaders/` of the installation or of the source tree that built the
/// program. Cache: $LIGHTLOOM_CACHE, else $XDG_CACHE_HOME/lightloom, else ~/.cache/lightloom, else a folder in the
/// temporary folder. Throws Error(run_failed) when no source folder exists.
[[nodiscard]] ShaderFolders default_shader_folders();

}  // namespace lightloom::run
