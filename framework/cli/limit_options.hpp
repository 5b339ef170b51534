#pragma once

#include <vector>

#include "framework/cli/argument_parser.hpp"
#include "framework/scene/load_options.hpp"

namespace lightloom::cli {

/// `--limit` and `--allow-outside`: what input files may ask for. Shared by all commands that read scenes or images.
/// They stand on the command line alone, never in a file, which could raise them for itself.
struct LimitOptions {
  std::vector<Assignment> limits;
  bool allow_outside = false;

  void add_to(Command& command);
  /// `--limit` alone, for commands that read no glTF files.
  void add_limits_to(Command& command);
  [[nodiscard]] scene::LoadOptions load_options() const;
};

}  // namespace lightloom::cli
