#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/cli/argument_parser.hpp"
#include "framework/cli/cache_option.hpp"
#include "framework/cli/graph_options.hpp"
#include "framework/cli/limit_options.hpp"
#include "framework/cli/program.hpp"
#include "framework/run/render.hpp"

namespace lightloom::cli {

/// The graph, the scene, and the options on which the bits of a frame depend; shared by `render` and `probe`.
struct PictureOptions {
  std::filesystem::path graph;
  std::filesystem::path scene;
  GraphOptions changes;
  LimitOptions limits;
  std::string camera;
  std::filesystem::path camera_path;
  Range frames;
  uint32_t seed = 0;
  double frames_per_second = 30;
  std::optional<double> time;
  std::vector<std::filesystem::path> shaders;
  CacheOption cache;

  /// The argument GRAPH.
  void add_graph_to(Command& command);
  void add_to(Command& command);
  /// What they ask for; without the run folder, the device and what goes with them.
  [[nodiscard]] run::RenderRequest request(const CommandContext& context) const;
};

/// `--shaders`: folders to put before the program's own.
void add_shaders_option(Command& command, std::vector<std::filesystem::path>& folders);

/// The largest number that a frame can have; keeps six digits in file names.
constexpr uint32_t kLastFrame = 999'999;

}  // namespace lightloom::cli
