#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "framework/base/diagnostics.hpp"
#include "framework/gpu/device.hpp"
#include "framework/graph/link.hpp"
#include "framework/graph/pass_type.hpp"
#include "framework/graph/plan.hpp"
#include "framework/run/check_options.hpp"
#include "framework/run/frame_loop.hpp"
#include "framework/run/plugins.hpp"
#include "framework/run/run_folder.hpp"
#include "framework/run/shader_folders.hpp"

namespace lightloom::run {

/// One call of `lightloom render`.
struct RenderRequest {
  std::filesystem::path graph;
  std::filesystem::path scene;
  LinkOptions link;                   ///< variants, disables, swaps, sets, captures (--dump), view size
  CompileOptions compile;             ///< how the graph is executed
  CheckOptions checks;                ///< what to look for in every value
  std::string camera;                 ///< empty: the scene's first
  std::filesystem::path camera_path;  ///< keyframes that the camera follows; empty: it does what the scene says
  uint32_t seed = 0;
  uint32_t first_frame = 0;  ///< inclusive
  uint32_t last_frame = 0;   ///< inclusive
  double frames_per_second = 30;
  std::optional<double> frozen_time;  ///< every frame shows the scene at this time [s]
  std::filesystem::path out;          ///< run folder, made if missing
  bool share_memory = true;           ///< values that are not live at the same time share memory
  bool time_passes = true;            ///< ExecutorOptions::time_passes
  DumpFormat dump_format = DumpFormat::exr;
  FrameSet output_frames;  ///< whose outputs are written
  FrameSet dump_frames;    ///< whose captures are written
  /// Frames between two checkpoints; the last frame gets one as well. 0: none.
  uint32_t checkpoint_every = 0;
  /// Go on from the checkpoint of the run folder, if it has one, instead of starting anew.
  bool resume = false;
  gpu::DeviceOptions device;
  ShaderFolders shaders = default_shader_folders();
  std::vector<LoadedPlugin> plugins;      ///< for the provenance record
  std::vector<std::string> command_line;  ///< for the provenance record
};

struct RenderSummary {
  std::filesystem::path folder;
  std::vector<std::filesystem::path> images;  ///< the `image` output of each frame, or the first output's files
  std::vector<std::string> warnings;          ///< of the graph and the scene, and what the validation layers said
  std::vector<std::string> failures;          ///< of the checks: why the render counts as failed
  uint32_t frames = 0;                        ///< that are there: fewer than asked for where a check ended the render
  uint32_t frames_resumed = 0;                ///< of an interrupted run that were there already
  double milliseconds_per_frame = 0;          ///< median wall time
};

/// Renders the frames one after another and writes the run folder (design, section 5). Problems of the graph file or of
/// the options go to `diagnostics`, and nothing is written; everything else is thrown as Error.
/// Returns false when `diagnostics` has errors.
bool render(const RenderRequest& request, const PassRegistry& registry, const FrameCallback& on_frame,
            Diagnostics& diagnostics, RenderSummary& summary);

}  // namespace lightloom::run
