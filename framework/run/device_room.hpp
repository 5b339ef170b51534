#pragma once

#include <cstdint>
#include <string>

#include "framework/gpu/device.hpp"
#include "framework/gpu/result.hpp"
#include "framework/graph/graph.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::run {

/// What a device offers to the images of a graph.
struct DeviceRoom {
  std::string device;            ///< its name, for messages
  uint64_t bytes = 0;            ///< memory that is left, for all images together
  uint64_t bytes_per_image = 0;  ///< 0: no limit of its own
  uint32_t side_2d = 0;          ///< most texels along a side of a 2D image …
  uint32_t side_3d = 0;          ///< … and of a volume
  uint32_t layers = 0;           ///< most layers of a history ring
};

[[nodiscard]] DeviceRoom room_of(const gpu::Device& device);

/// Device memory that a run needs [bytes], without what its values save by sharing and without acceleration structures.
struct MemoryDemand {
  uint64_t volumes = 0;   ///< voxel grids
  uint64_t pictures = 0;  ///< all other values, with their histories
  uint64_t readback = 0;  ///< of outputs and captures, for the frames that are written while the next one is rendered
  uint64_t geometry = 0;  ///< vertices, triangles, materials
  uint64_t textures = 0;  ///< of materials, with their mip levels, and of the environment
  [[nodiscard]] uint64_t bytes() const { return volumes + pictures + readback + geometry + textures; }
};
[[nodiscard]] MemoryDemand demand_of(const Graph& graph, const scene::Scene& scene);

/// The failure of an allocation, with what the whole run needs, what the device had before it, and what to lower to
/// which value.
[[nodiscard]] gpu::OutOfMemory with_demand(const gpu::OutOfMemory& error, const Graph& graph,
                                           const MemoryDemand& demand, const DeviceRoom& room);

/// Throws Error(run_failed) when the images of the graph's values, with their rings, go beyond the limits or the memory
/// of the device: before anything is allocated, with the bytes needed and those there are, and with what to lower.
void require_room(const Graph& graph, const DeviceRoom& room);

}  // namespace lightloom::run
