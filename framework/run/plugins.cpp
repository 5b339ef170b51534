#include "framework/run/plugins.hpp"

#include <dlfcn.h>

#include <exception>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/graph/plugin.hpp"
#include "framework/run/version.hpp"

namespace lightloom::run {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& file, const std::string& why, const std::string& hint = {}) {
  throw Error(ExitCode::invalid_input, "plug-in " + in_quotes(file.string()) + " " + why, hint);
}

std::shared_ptr<void> open(const fs::path& file) {
  if (!fs::is_regular_file(file)) refuse(file, "is not there");
  // With a slash, or the loader would search the system's folders for it.
  void* handle = dlopen(fs::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    const char* message = dlerror();
    refuse(file, std::string("cannot be loaded: ") + (message == nullptr ? "no reason given" : message),
           "a symbol that is missing means that it was built against another Lightloom");
  }
  return {handle, [](void* library) { (void)dlclose(library); }};
}

const Plugin& entry(const fs::path& file, void* library) {
  const auto* plugin = static_cast<const Plugin*>(dlsym(library, "lightloom_plugin"));
  if (plugin == nullptr)
    refuse(file, "exports no 'lightloom_plugin'", "it must be declared extern \"C\", see framework/graph/plugin.hpp");
  if (plugin->interface != plugin_interface())
    refuse(file,
           "was built against Lightloom " + std::string(plugin->lightloom_version) +
               " with another interface of passes than this one, " + version(),
           "build it again against this installation, with the same compiler");
  return *plugin;
}

}  // namespace

LoadedPlugin load_plugin(const fs::path& file, PassRegistry& registry) {
  LoadedPlugin loaded;
  loaded.file = file;
  loaded.library = open(file);
  const Plugin& plugin = entry(file, loaded.library.get());
  loaded.name = plugin.name;
  loaded.version = plugin.version;
  const fs::path shaders = fs::absolute(file).parent_path() / "shaders";
  if (fs::is_directory(shaders)) loaded.shaders = shaders;
  PassRegistry with_its_own = registry;
  try {
    plugin.add_passes(with_its_own);
  } catch (const std::exception& error) {
    refuse(file, std::string("has a pass type that is refused: ") + error.what());
  }
  registry = std::move(with_its_own);
  return loaded;
}

ShaderFolders shader_folders_with(const std::vector<LoadedPlugin>& plugins) {
  ShaderFolders folders = default_shader_folders();
  for (const LoadedPlugin& plugin : plugins)
    if (!plugin.shaders.empty()) folders.sources.push_back(plugin.shaders);
  return folders;
}

}  // namespace lightloom::run
