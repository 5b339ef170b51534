#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lightloom::cli {

/// The plug-ins that a command line and the environment name, and the command line without them. Plug-ins are loaded
/// before commands are declared, because help and completion know their pass types.
struct PluginArguments {
  std::vector<std::filesystem::path> plugins;  ///< those of $LIGHTLOOM_PLUGINS (separated by ':'), then of --plugin
  std::vector<std::string> rest;
};

/// `--plugin FILE` and `--plugin=FILE` may stand anywhere before `--`; one without a file stays in `rest`, where the
/// parser reports it.
[[nodiscard]] PluginArguments take_plugin_arguments(const std::vector<std::string>& arguments,
                                                    const std::string& environment);

}  // namespace lightloom::cli
