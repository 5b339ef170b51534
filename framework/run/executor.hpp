#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "framework/gpu/command_session.hpp"
#include "framework/gpu/device.hpp"
#include "framework/gpu/timestamps.hpp"
#include "framework/graph/plan.hpp"
#include "framework/run/executor_state.hpp"
#include "framework/run/frame_result.hpp"
#include "framework/run/host_passes.hpp"
#include "framework/run/lost_frame.hpp"
#include "framework/run/pass_recorder.hpp"
#include "framework/run/poison.hpp"
#include "framework/run/readback.hpp"
#include "framework/run/scene_memo.hpp"
#include "framework/run/scene_resources.hpp"
#include "framework/run/shader_folders.hpp"
#include "framework/run/value_images.hpp"
#include "framework/run/value_scan.hpp"

namespace lightloom::run {

struct ExecutorOptions {
  ShaderFolders shaders;
  std::string camera;                                           ///< empty: the scene's first
  std::optional<scene::CameraPath> camera_path = std::nullopt;  ///< moves the camera instead of what the scene says
  uint32_t seed = 0;
  double frames_per_second = 30;                     ///< animation time of frame f is f / frames_per_second
  std::optional<double> frozen_time = std::nullopt;  ///< every frame shows the scene at this time [s]
  bool share_memory = true;                          ///< values that are not live at the same time share memory
  std::optional<PoisonTone> poison = std::nullopt;   ///< fills what nobody wrote; the bits stay the same
  /// Each pass is timed on its own, by timestamps between full barriers. Without, only the plan's barriers stand
  /// between passes, which may overlap as far as these allow, and there are no times of device passes. The bits are the
  /// same.
  bool time_passes = true;
  /// What host passes derive from the scene, to be shared by executors on the same one; empty: the executor's own.
  std::shared_ptr<SceneMemo> memo = nullptr;
  /// Shaders and pipelines, to be shared by executors on the same device with the same `shaders`; empty: the executor's
  /// own.
  std::shared_ptr<ShaderLibrary> library = nullptr;
  /// Of the scene's vertices or triangles, so many bytes at the most lie in one block of a shader; empty: what the
  /// device allows. The bits are the same.
  std::optional<uint64_t> geometry_piece_bytes = std::nullopt;
  bool single_texels = false;  ///< of what is read back one texel each comes to the host: Executor::look_at
};

/// A frame that the device is done with, its images still where the device put them.
struct FinishedFrame {
  FrameResult result;  ///< without images
  FrameWants wants;
  std::shared_ptr<const FrameCopies> copies;  ///< to be let go before the device goes
};

/// Turns a plan into Vulkan objects and runs frames. Owns the images and history rings; passes own nothing.
class Executor {
 public:
  /// `device` and `scene` outlive the executor. Throws Error for what a pass needs and the device lacks, for a camera
  /// that the scene lacks, for values beyond the device's limits, and for shaders that do not compile.
  Executor(gpu::Device& device, Plan plan, const scene::Scene& scene, const ExecutorOptions& options);
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;
  ~Executor();

  /// Runs frame number `frame` after the frames run so far, which are its history, and waits for it. What is not wanted
  /// is not copied, which changes no bit of this or any other frame. Throws Interrupted before it where a stop was
  /// requested.
  [[nodiscard]] FrameResult run_frame(uint32_t frame, const FrameWants& wants = {});

  /// The same in steps, so that the host can do something else while the device works, with one frame at a time under
  /// way: records and submits a frame; returns before the device is done, unless host passes come late in the plan.
  void start_frame(uint32_t frame, const FrameWants& wants = {});
  /// Waits for the frame that was started.
  [[nodiscard]] FinishedFrame finish_frame();
  /// The result with its images. From any thread, while this executor may be busy with the next frame.
  [[nodiscard]] FrameResult fetch(const FinishedFrame& frame) const;

  /// What the next frame goes on from. At least one frame has run, and none is under way.
  [[nodiscard]] ExecutorState save() const;
  /// Goes on from there, before the first frame, as if this executor had run those frames with the same plan, scene and
  /// options: the next ones have the same bits. Throws Error(invalid_input) for a state of another graph.
  void restore(const ExecutorState& state);
  /// Begins, before the first frame, at one that others came before, with the layers that it reads given.
  void start_at(const FrameStart& start);
  /// Runs the last frame again, with the same conditions and the same layers: the same bits. What a plan runs once does
  /// not run again.
  [[nodiscard]] FrameResult repeat_frame(const FrameWants& wants = {});

  /// With ExecutorOptions::single_texels: which texel of each value, by its id, is read back from now on; the first
  /// texel before.
  void look_at(const std::vector<VkOffset3D>& texels) { readback_.look_at(texels); }

  /// What had to be changed in the scene for the device.
  [[nodiscard]] const std::vector<std::string>& scene_warnings() const { return scene_.warnings(); }
  [[nodiscard]] const Plan& plan() const { return plan_; }
  [[nodiscard]] const MemorySharing& memory_sharing() const { return images_.sharing(); }
  /// AccessWatch::bound, of the passes that have run.
  [[nodiscard]] const std::map<std::string, std::set<std::string>>& bound_names() const { return watch_.bound(); }
  /// Device memory of all values with their rings [bytes].
  [[nodiscard]] uint64_t value_bytes() const { return images_.bytes(); }
  /// Frames whose images could be on the host, or on their way, at the same time so far.
  [[nodiscard]] size_t readback_sets() const { return readback_.set_count(); }

 private:
  /// Poses the scene as in these frames, so that it remembers them.
  void pass_through(const std::vector<uint32_t>& frames);
  void run_prologue();
  void start(uint32_t frame, const FrameWants& wants);
  [[nodiscard]] FinishedFrame finish();
  void remember(uint32_t frame);
  void record_frame(gpu::CommandSession& session, const FrameCopies& copies);
  void record_prologue(VkCommandBuffer commands) const;
  /// Timestamps are queries `first_query` and on, two a step. What comes before a host pass is submitted.
  void record_steps(gpu::CommandSession& session, const std::vector<PlanStep>& steps, uint32_t first_query,
                    const FrameCopies& copies);
  void record_pass(VkCommandBuffer commands, const GraphPass& pass);
  void run_host_pass(gpu::CommandSession& session, const GraphPass& pass);
  /// The frame that the device was lost in.
  [[nodiscard]] LostFrame lost_frame(uint32_t frame) const;
  void record_timestamp(VkCommandBuffer commands, uint32_t query) const;
  void record_observations(VkCommandBuffer commands, const std::vector<Observation>& observations,
                           const FrameCopies& copies);
  void collect_times(FinishedFrame& frame) const;
  [[nodiscard]] std::vector<PassTime> times_of(const std::vector<PlanStep>& steps, const std::vector<double>& stamps,
                                               size_t first_query) const;

  gpu::Device& device_;
  Plan plan_;
  ValueImages images_;
  Readback readback_;
  HostPasses host_passes_;
  SceneResources scene_;
  std::shared_ptr<SceneMemo> memo_;
  Placeholders placeholders_;
  std::shared_ptr<ShaderLibrary> shaders_;
  std::optional<Poison> poison_;
  std::optional<ValueScan> scan_;  ///< where the plan has any
  gpu::DescriptorAllocator descriptors_;
  AccessWatch watch_;
  gpu::TimestampPool timestamps_;
  bool stamping_ = false;                                         ///< the frame that is being recorded
  std::map<std::string, double, std::less<>> host_milliseconds_;  ///< by pass, of its last run
  std::optional<FinishedFrame> under_way_;                        ///< what is known of it beforehand
  uint64_t frame_count_ = 0;                                      ///< with those before `restore`
  bool initialised_ = false;                                      ///< the prologue has run
  bool started_ = false;                                          ///< has run a frame itself
  FrameConditions conditions_;                                    ///< of the last frame that it has run itself
  std::vector<uint32_t> recent_frames_;                           ///< numbers, oldest first, at most kHistoryLimit
};

}  // namespace lightloom::run
