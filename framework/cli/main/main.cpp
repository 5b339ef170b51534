#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "framework/base/progress.hpp"
#include "framework/cli/messages.hpp"
#include "framework/cli/plugin_arguments.hpp"
#include "framework/cli/program.hpp"
#include "framework/run/plugins.hpp"
#include "passes/registry.hpp"

int main(int argc, char** argv) {
  using namespace lightloom;
  std::vector<run::LoadedPlugin> plugins;  // outlives the registry, which holds functions of theirs
  PassRegistry registry;
  passes::register_builtin_passes(registry);
  const char* listed = std::getenv("LIGHTLOOM_PLUGINS");
  const cli::PluginArguments arguments =
      cli::take_plugin_arguments({argv + 1, argv + argc}, listed == nullptr ? "" : listed);
  try {
    for (const std::filesystem::path& file : arguments.plugins) plugins.push_back(run::load_plugin(file, registry));
  } catch (const Error& error) {
    cli::print_error(std::cerr, error.what(), error.hint());
    return static_cast<int>(error.code());
  }
  const cli::CommandContext context{std::cout, std::cerr, standard_error_is_terminal(), registry, plugins};
  const ExitCode code = cli::run_program(arguments.rest, context);
  std::cout.flush();
  std::cerr.flush();
  // Not by return: what drivers do at the end of a process would wait for a device that hangs.
  std::_Exit(static_cast<int>(code));
}
