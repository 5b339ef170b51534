#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/cli/argument_parser.hpp"
#include "framework/graph/pass_type.hpp"
#include "framework/run/plugins.hpp"

namespace lightloom::cli {

/// What every command works with. Results go to `out`; messages and progress go to `err`.
struct CommandContext {
  std::ostream& out;
  std::ostream& err;
  bool err_is_terminal = false;  ///< whether a progress bar is drawn
  const PassRegistry& registry;
  std::vector<run::LoadedPlugin> plugins = {};  ///< whose pass types are in the registry
};

/// Runs `lightloom ARGUMENTS` after plug-ins have been taken out (take_plugin_arguments). The one place where an Error
/// becomes a message and an exit code; never throws.
[[nodiscard]] ExitCode run_program(const std::vector<std::string>& arguments, const CommandContext& context);

}  // namespace lightloom::cli
