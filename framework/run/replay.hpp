#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/base/diagnostics.hpp"
#include "framework/gpu/device.hpp"
#include "framework/graph/pass_type.hpp"
#include "framework/graph/plan.hpp"
#include "framework/image/bit_difference.hpp"
#include "framework/run/frame_result.hpp"
#include "framework/run/plugins.hpp"
#include "framework/run/shader_folders.hpp"
#include "framework/scene/load_options.hpp"

namespace lightloom::run {

/// One call of `lightloom replay`.
struct ReplayRequest {
  std::filesystem::path folder;     ///< of a run with dumps
  std::vector<std::string> passes;  ///< names or globs
  std::optional<uint32_t> frame;    ///< the last dumped one unless given
  std::filesystem::path graph;      ///< an edited graph file; empty: the graph as it was recorded
  std::filesystem::path scene;      ///< where the scene is now; empty: as recorded
  scene::LoadOptions load;          ///< what the files of the scene may ask for
  std::vector<std::pair<std::string, std::string>> swaps;  ///< as in LinkOptions, after those of the run
  std::vector<std::pair<std::string, std::string>> sets;
  CompileOptions compile;
  bool compare = false;       ///< hold the outputs against the dumps even where something has changed
  uint32_t repeat = 1;        ///< times that the passes run, for their times
  std::filesystem::path out;  ///< run folder of what they write; empty: `replay` in `folder`
  gpu::DeviceOptions device;
  ShaderFolders shaders = default_shader_folders();
  std::vector<LoadedPlugin> plugins;
  std::vector<std::string> command_line;
};

/// What a replayed pass wrote.
struct ReplayedValue {
  std::string name;  ///< "pass.port[.part]"
  bool dumped = false;
  std::optional<image::BitDifference> difference;  ///< from the dump, if it was held against it
  uint64_t texels = 0;                             ///< of the value
  std::vector<std::string> channels;
};

struct ReplaySummary {
  uint32_t frame = 0;
  std::vector<std::string> changes;  ///< what is not as it was in the run, in words
  std::vector<std::string> notes;    ///< where the inputs come from
  std::vector<PassTime> times;       ///< medians, in execution order
  std::vector<ReplayedValue> values;
  bool compared = false;
  bool same = true;  ///< every value that was compared has the bits of its dump
  std::filesystem::path folder;
  std::vector<std::string> warnings;
};

/// Runs passes of one frame of a recorded run again, from the dumps of what they read: alone, without any other pass or
/// frame. Inputs of frames before the run's first are zeros, as they were. Problems of the graph or the options go to
/// `diagnostics`, and false is returned; everything else is thrown as Error: (invalid_input) lists all inputs that were
/// not dumped.
bool replay(const ReplayRequest& request, const PassRegistry& registry, Diagnostics& diagnostics,
            ReplaySummary& summary);

}  // namespace lightloom::run
