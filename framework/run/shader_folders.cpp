#include "framework/run/shader_folders.hpp"

#include <cstdlib>
#include <string>

#include "framework/base/error.hpp"

namespace lightloom::run {
namespace {

namespace fs = std::filesystem;

fs::path environment_path(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? fs::path() : fs::path(value);
}

fs::path cache_folder() {
  if (const fs::path chosen = environment_path("LIGHTLOOM_CACHE"); !chosen.empty()) return chosen;
  if (const fs::path xdg = environment_path("XDG_CACHE_HOME"); !xdg.empty()) return xdg / "lightloom";
  if (const fs::path home = environment_path("HOME"); !home.empty()) return home / ".cache" / "lightloom";
  return fs::temp_directory_path() / "lightloom-cache";
}

fs::path source_folder() {
  if (const fs::path chosen = environment_path("LIGHTLOOM_SHADERS"); !chosen.empty()) {
    if (!fs::is_directory(chosen))
      throw Error(ExitCode::run_failed, "LIGHTLOOM_SHADERS names '" + chosen.string() + "', which is not a folder");
    return chosen;
  }
  std::error_code ignored;
  const fs::path executable = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path installed = executable.parent_path().parent_path() / "share" / "lightloom" / "shaders";
  if (fs::is_directory(installed, ignored)) return installed;
  const fs::path built_from = LIGHTLOOM_SHADER_SOURCE_DIR;
  if (fs::is_directory(built_from, ignored)) return built_from;
  throw Error(ExitCode::run_failed,
              "the shaders are neither in '" + installed.string() + "' nor in '" + built_from.string() + "'",
              "set LIGHTLOOM_SHADERS to the folder 'shaders' of the source tree");
}

}  // namespace

ShaderFolders default_shader_folders() {
  return {.sources = {source_folder()}, .cache = cache_folder()};
}

}  // namespace lightloom::run
