#pragma once

#include "framework/gpu/device.hpp"
#include "framework/graph/graph.hpp"

namespace lightloom::run {

/// Does some pass of the graph need ray queries?
[[nodiscard]] bool needs_ray_queries(const Graph& graph);

/// Throws Error(no_device) where a pass of the graph needs what the device lacks: it names the pass, its type, the
/// device and what is missing.
void require_device_needs(const Graph& graph, const gpu::DeviceInfo& device);

}  // namespace lightloom::run
