#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "framework/base/diagnostics.hpp"
#include "framework/base/file_watch.hpp"
#include "framework/base/folder_lock.hpp"
#include "framework/gpu/device.hpp"
#include "framework/graph/link.hpp"
#include "framework/graph/pass_type.hpp"
#include "framework/graph/plan.hpp"
#include "framework/run/check_options.hpp"
#include "framework/run/frame_loop.hpp"
#include "framework/run/plugins.hpp"
#include "framework/run/run_folder.hpp"
#include "framework/run/shader_folders.hpp"
#include "framework/run/shader_library.hpp"
#include "framework/scene/load_options.hpp"

namespace lightloom::run {

/// One call of `lightloom render`.
struct RenderRequest {
  std::filesystem::path graph;
  std::filesystem::path scene;
  scene::LoadOptions load;            ///< what the files of the scene may ask for
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
  std::chrono::duration<double> checkpoint_time{0};  ///< FrameLoopOptions::checkpoint_time
  /// Go on from the checkpoint of the run folder, if it has one, instead of starting anew.
  bool resume = false;
  gpu::DeviceOptions device;
  ShaderFolders shaders = default_shader_folders();
  std::vector<LoadedPlugin> plugins;      ///< for the provenance record
  std::vector<std::string> command_line;  ///< for the provenance record
};

struct RenderSummary {
  std::filesystem::path folder;
  std::filesystem::path picture;      ///< the last one that a person would open; empty: none
  std::vector<std::string> warnings;  ///< of the graph and the scene, and what the validation layers said
  std::vector<std::string> failures;  ///< of the checks: why the render counts as failed
  uint32_t frames = 0;                ///< that are there: fewer than asked for where a check ended the render
  uint32_t frames_resumed = 0;        ///< of an interrupted run that were there already
  double milliseconds_per_frame = 0;  ///< median wall time
  int interrupted_by = 0;             ///< the signal that ended it early; 0: none
};

struct RenderEvents {
  FrameCallback on_frame;
  std::function<void(uint32_t frame)> on_written;  ///< when a frame's files are whole, on another thread
};

/// Renders requests one after another, for which it keeps the device, the scene, and compiled shaders with their
/// pipelines. The requests have the same device, shader folders, scene file and run folder; the files themselves may
/// change, and `forget` is told which did. The bits are those of `render`.
class Renderer {
 public:
  /// `registry` outlives it.
  explicit Renderer(const PassRegistry& registry);
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;
  ~Renderer();

  /// As `render`. When it fails before the first frame has been rendered, the run folder is as it was.
  bool render(const RenderRequest& request, const RenderEvents& events, Diagnostics& diagnostics,
              RenderSummary& summary);
  /// What the last request was made of, as far as it came: graph, camera path, scene, shaders with their includes.
  [[nodiscard]] FileContents files_read() const;
  /// These are to be read anew.
  void forget(const std::vector<std::filesystem::path>& changed);

 private:
  struct LoadedScene;
  const std::filesystem::path& noted(const std::filesystem::path& file);
  void load(const RenderRequest& request);

  const PassRegistry& registry_;
  FileContents files_;  ///< graph, camera path, and the scene's when it was loaded last
  std::unique_ptr<LoadedScene> scene_;
  std::unique_ptr<gpu::Device> device_;
  std::shared_ptr<ShaderLibrary> library_;
  std::optional<FolderLock> lock_;                 ///< on the run folder, from the first render on
  std::vector<std::filesystem::path> broken_off_;  ///< files of a render that ended by an exception
};

/// Renders the frames one after another and writes the run folder (design, section 5), which nobody else may write into
/// meanwhile (FolderLock). A request to stop (base/interrupt.hpp) ends it after the frame under way; the folder is then
/// that of a run with fewer frames, and its run.json says so. Throws Interrupted where no frame was done. Problems of
/// the graph file or of the options go to `diagnostics`, and nothing is written; everything else is thrown as Error.
/// Returns false when `diagnostics` has errors.
bool render(const RenderRequest& request, const PassRegistry& registry, const FrameCallback& on_frame,
            Diagnostics& diagnostics, RenderSummary& summary);

}  // namespace lightloom::run
