#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "framework/gpu/device.hpp"
#include "framework/graph/plan.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::study {

/// Hash of all that a scene is made of, as loaded: geometry, materials, images, lights, environment.
[[nodiscard]] uint64_t scene_hash(const scene::Scene& scene);

/// Hash of what moves: the pose (dynamic vertices, cameras, lights) at each of these times [s]. Zero where the scene
/// stands still.
[[nodiscard]] uint64_t motion_hash(const scene::Scene& scene, const std::vector<double>& times);

/// All that the frames of a cell depend on.
struct RenderIdentity {
  const Plan* plan = nullptr;
  const scene::Scene* scene = nullptr;
  uint64_t scene_hash = 0;
  std::string camera;
  uint32_t seed = 0;
  uint32_t first_frame = 0;
  uint32_t frames = 0;
  uint32_t kept = 1;  ///< so many frames at last are kept
  double frames_per_second = 30;
  std::string output;
  uint64_t code_hash = 0;
};

/// Hash of every file in these folders (shaders, which may be edited without a new build) and of these files
/// (plug-ins).
[[nodiscard]] uint64_t code_hash(const std::vector<std::filesystem::path>& folders,
                                 const std::vector<std::filesystem::path>& files);

/// Names the folder of a cell: 16 hexadecimal digits of what it depends on, the device, the program's version and the
/// version of the folder's format.
[[nodiscard]] std::string cell_key(const RenderIdentity& identity, const gpu::DeviceInfo& device);

}  // namespace lightloom::study
