#include "framework/run/device_needs.hpp"

#include <algorithm>

#include "framework/base/error.hpp"

namespace lightloom::run {

bool needs_ray_queries(const Graph& graph) {
  return std::any_of(graph.passes.begin(), graph.passes.end(),
                     [](const GraphPass& pass) { return pass.type->needs.ray_query; });
}

void require_device_needs(const Graph& graph, const gpu::DeviceInfo& device) {
  if (device.ray_query.available) return;
  for (const GraphPass& pass : graph.passes) {
    if (!pass.type->needs.ray_query) continue;
    throw Error(ExitCode::no_device,
                "pass '" + pass.name + "' (" + pass.type->name +
                    ") needs VK_KHR_ray_query and VK_KHR_acceleration_structure, but device '" + device.name +
                    "' lacks " + device.ray_query.missing,
                "'lightloom devices' tells which device has ray queries; other types that trace light on any device "
                "are voxel_path_trace and reference_path_trace (--swap " +
                    pass.name + "=reference_path_trace)");
  }
}

}  // namespace lightloom::run
