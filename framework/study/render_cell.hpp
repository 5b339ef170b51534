#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/gpu/device.hpp"
#include "framework/graph/plan.hpp"
#include "framework/image/host_image.hpp"
#include "framework/run/scene_memo.hpp"
#include "framework/run/shader_folders.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::study {

/// Frames to be rendered one after another from `first_frame`; the last `kept` of them are handed out.
struct RenderJob {
  Plan plan;
  const scene::Scene* scene = nullptr;
  std::shared_ptr<run::SceneMemo> memo;
  std::string camera;
  uint32_t seed = 0;
  uint32_t first_frame = 0;
  uint32_t frames = 1;
  uint32_t kept = 1;
  double frames_per_second = 30;
  std::optional<double> frozen_time = std::nullopt;  ///< every frame shows the scene at this time [s]
  std::string output = "radiance";                   ///< of the graph, linear radiance
  run::ShaderFolders shaders;
};

/// Times [ms]. Device time by pass and frame is negative where the device has no timestamps.
struct CellTimes {
  std::vector<std::string> passes;          ///< what every frame runs, in order
  std::vector<std::vector<double>> frames;  ///< [frame][pass]
  std::vector<std::pair<std::string, double>> once;
  std::vector<double> wall;   ///< [frame], on the host, read-back included
  uint64_t memory_bytes = 0;  ///< of the values on the device
};

struct Rendering {
  std::vector<image::HostImage> radiance;          ///< of the kept frames
  std::vector<uint32_t> frame_numbers;             ///< parallel to `radiance`
  std::optional<image::HostImage> picture;         ///< the last frame's output `image`, if that is rgba8_unorm
  std::optional<image::HostImage> standard_error;  ///< the last frame's output of that name
  CellTimes times;
  std::vector<std::string> warnings;
};

/// Called after each frame.
using FrameCallback = std::function<void()>;

/// Throws Error for what cannot be run on the device, an unknown camera, or a graph without the output.
[[nodiscard]] Rendering render_job(gpu::Device& device, const RenderJob& job, const FrameCallback& on_frame = {});

/// Index of that output. Throws Error(invalid_input) that lists the outputs, or says that it is no colour image of
/// floating-point numbers.
[[nodiscard]] size_t judged_output(const Graph& graph, const std::string& name);

}  // namespace lightloom::study
