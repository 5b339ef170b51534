#pragma once

#include <cstdint>
#include <string>

#include "framework/gpu/device.hpp"
#include "framework/graph/graph.hpp"

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

/// Throws Error(run_failed) when the images of the graph's values, with their rings, go beyond the limits or the memory
/// of the device: before anything is allocated, with the bytes needed and those there are, and with what to lower.
void require_room(const Graph& graph, const DeviceRoom& room);

}  // namespace lightloom::run
