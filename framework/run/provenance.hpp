#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "framework/gpu/device.hpp"
#include "framework/graph/plan.hpp"
#include "framework/graph/share_memory.hpp"
#include "framework/run/frame_result.hpp"
#include "framework/run/plugins.hpp"
#include "framework/scene/camera_path.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::run {

[[nodiscard]] nlohmann::ordered_json device_record(const gpu::DeviceInfo& info);
[[nodiscard]] nlohmann::ordered_json plugin_records(const std::vector<LoadedPlugin>& plugins);
[[nodiscard]] nlohmann::ordered_json scene_record(const scene::Scene& scene);
/// File, interpolation and keyframes; null without a path.
[[nodiscard]] nlohmann::ordered_json camera_path_record(const std::optional<scene::CameraPath>& path);
/// Number, time [s], earlier frames in the histories, seed, bounds of the scene [m]; view_projection as rows, so that
/// clip = view_projection * (x, y, z, 1) with Vulkan's axes; eye as in shaders/lib/scene.glsl. All these coordinates,
/// as those in the frame's images, are those of the world less `scene_origin` [m].
[[nodiscard]] nlohmann::ordered_json frame_record(const FrameResult& frame, uint32_t seed, const scene::Scene& scene);
/// Name, hash of the plan, sizes, params, outputs, what was culled and bypassed, memory.
[[nodiscard]] nlohmann::ordered_json graph_record(const Plan& plan);
/// One entry a heap: its bytes, the least that any sharing needs, and what its values would need apart.
[[nodiscard]] nlohmann::ordered_json sharing_records(const MemorySharing& sharing);
/// One entry a pass that every frame runs, in execution order: name, type, version, inputs, params, time of each frame
/// and their median [ms]; times are null where the device has no timestamps.
[[nodiscard]] nlohmann::ordered_json pass_records(const Plan& plan, const std::vector<std::vector<PassTime>>& frames);
/// One entry a pass that the first frame alone runs, in execution order: the same, but why, and its one time [ms].
[[nodiscard]] nlohmann::ordered_json once_records(const Plan& plan, const std::vector<PassTime>& times);

/// Middle value; mean of the two middle ones for an even number. 0 for none.
[[nodiscard]] double median(std::vector<double> values);

}  // namespace lightloom::run
