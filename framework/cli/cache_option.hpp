#pragma once

#include "framework/cli/argument_parser.hpp"
#include "framework/run/shader_folders.hpp"

namespace lightloom::cli {

/// `--no-cache`, shared by all commands that compile shaders or make pipelines.
struct CacheOption {
  bool off = false;

  void add_to(Command& command) {
    command.flag("--no-cache", off,
                 "Neither read nor write compiled shaders and pipelines on disk; the results are the same");
  }
  /// The folders without that of the cache where it is off.
  [[nodiscard]] run::ShaderFolders apply_to(run::ShaderFolders folders) const {
    if (off) folders.cache.clear();
    return folders;
  }
};

}  // namespace lightloom::cli
