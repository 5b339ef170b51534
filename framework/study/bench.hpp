#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "framework/gpu/device.hpp"
#include "framework/graph/plan.hpp"
#include "framework/run/executor.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::study {

/// One of the runs that are measured beside each other.
struct BenchRun {
  std::string name;  ///< as tables show it
  Plan plan;
  double plan_ms = 0;  ///< reading, linking and compiling the graph
  run::ExecutorOptions options;
};

struct BenchSettings {
  uint32_t first_frame = 0;
  uint32_t frames = 20;   ///< measured, of each run
  uint32_t warm_up = 10;  ///< run before them and not measured, the first frame included; at least 1
};

/// What the rays of a frame did, by the outputs `counts` of the passes that have one.
struct RayCounts {
  std::vector<std::string> passes;  ///< that counted
  double rays = 0;                  ///< marched in a frame
  double steps = 0;                 ///< of them
  std::vector<double> steps_by_pass{};
};

/// What one run cost. All times in ms.
struct BenchFigures {
  std::string name;
  double plan_ms = 0;
  double setup_ms = 0;                               ///< memory, the scene's upload
  double first_frame_ms = 0;                         ///< whole, with pipelines made and hoisted passes run
  std::vector<std::pair<std::string, double>> once;  ///< hoisted passes
  std::vector<double> frame_ms;                      ///< whole frames, free-running: from the host's first call to the
                                                     ///< last result read back
  std::vector<std::string> passes;                   ///< what every frame runs, in order
  std::vector<std::vector<double>> pass_ms;          ///< [pass][frame], measured one by one in frames of their own;
                                                     ///< empty where the device has no timestamps
  double shaders_ms = 0;                             ///< of the first frame: reading and compiling shaders …
  double pipelines_ms = 0;                           ///< … and making pipelines
  uint64_t value_bytes = 0;                          ///< device memory of the values
  gpu::MemoryBytes memory;                           ///< device memory of the whole run after its first frame
  std::map<std::string, std::set<std::string>> bound_names;  ///< Executor::bound_names
  std::optional<RayCounts> rays;
};

/// What the process held when the last frame was measured.
struct BenchMemory {
  uint64_t host = 0;             ///< [bytes]; of a device that is a CPU, the device's are among them
  uint64_t host_peak = 0;        ///< so far
  gpu::MemoryBytes device_peak;  ///< so far, of each purpose
  uint64_t device_peak_total = 0;
};

/// Called with how many of all frames are done.
using BenchCallback = std::function<void(uint32_t done, uint32_t total)>;

/// Runs the frames of all runs in turn, so that what disturbs the machine disturbs all of them, in an order that is
/// turned round from frame to frame. Each measured frame number is two frames: one free-running, one that times the
/// passes one by one. Throws Error for what cannot be run.
[[nodiscard]] std::vector<BenchFigures> measure(gpu::Device& device, const scene::Scene& scene,
                                                const std::vector<BenchRun>& runs, const BenchSettings& settings,
                                                const BenchCallback& on_frame = {});

/// Sums what the passes of a plan counted in one frame, from a plan in which their `counts` are captured.
[[nodiscard]] RayCounts count_rays(const run::FrameResult& frame);

}  // namespace lightloom::study
