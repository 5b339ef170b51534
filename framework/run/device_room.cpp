#include "framework/run/device_room.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/error.hpp"
#include "framework/gpu/memory.hpp"

namespace lightloom::run {
namespace {

constexpr uint32_t kLeastResolution = 8;  // of the pass `voxelize`

bool is_volume(const Value& value) {
  return value.desc.dimension == Dimension::d3;
}

uint32_t longest_side(const Value& value) {
  const Extent3& extent = value.desc.extent;
  return std::max({extent.width, extent.height, is_volume(value) ? extent.depth : 1});
}

std::string describe(const Value& value) {
  return "image '" + value_name(value) + "' (" + to_string(value.desc) + ")";
}

[[noreturn]] void refuse(const std::string& sentence, const std::string& hint) {
  throw Error(ExitCode::run_failed, sentence, hint);
}

/// What to lower for one image. `fitting`: longest side of a volume that would fit.
std::string lower_one(const Value& value, uint32_t fitting) {
  if (!is_volume(value)) return "choose a smaller --size, or a shorter history";
  return "lower the param 'resolution' to " + std::to_string(fitting) + " or less";
}

void require_image(const Value& value, const DeviceRoom& room) {
  const std::string of_device = " of device '" + room.device + "' may have";
  const uint32_t limit = is_volume(value) ? room.side_3d : room.side_2d;
  if (longest_side(value) > limit)
    refuse(describe(value) + " is " + std::to_string(longest_side(value)) + " texels long, more than the " +
               std::to_string(limit) + " that an image" + of_device,
           lower_one(value, limit));
  if (!is_volume(value) && ring_layers(value) > room.layers)
    refuse(describe(value) + " keeps " + std::to_string(ring_layers(value)) + " frames, more than the " +
               std::to_string(room.layers) + " layers that an image" + of_device,
           "choose a shorter history");
  const uint64_t bytes = is_volume(value) ? byte_size(value.desc) : byte_size(value);
  if (room.bytes_per_image == 0 || bytes <= room.bytes_per_image) return;
  const double scale = std::cbrt(static_cast<double>(room.bytes_per_image) / static_cast<double>(bytes));
  refuse(describe(value) + " needs " + gpu::bytes_text(bytes) + ", more than the " +
             gpu::bytes_text(room.bytes_per_image) + " that one image" + of_device,
         lower_one(value, static_cast<uint32_t>(scale * longest_side(value))));
}

/// All values of one kind.
struct Share {
  uint64_t bytes = 0;
  uint32_t longest = 0;  ///< [texels]
};

Share share_of(const Graph& graph, bool volumes) {
  Share share;
  for (const Value& value : graph.values) {
    if (is_volume(value) != volumes) continue;
    share.bytes += byte_size(value);
    share.longest = std::max(share.longest, longest_side(value));
  }
  return share;
}

/// What to lower when all images together are too many: the grid if a coarser one would fit, else the picture.
std::string lower_all(const Share& volumes, const Share& pictures, uint64_t available) {
  if (volumes.bytes > 0 && pictures.bytes < available) {
    const double scale =
        std::cbrt(static_cast<double>(available - pictures.bytes) / static_cast<double>(volumes.bytes));
    const auto fitting = static_cast<uint32_t>(scale * volumes.longest);
    if (fitting >= kLeastResolution)
      return "lower the param 'resolution' to " + std::to_string(fitting) +
             " or less, or use a device with more memory";
  }
  return "choose a smaller --size, a shorter history, or a device with more memory";
}

}  // namespace

DeviceRoom room_of(const gpu::Device& device) {
  const gpu::DeviceInfo& info = device.info();
  return {.device = info.name,
          .bytes = gpu::available_bytes(device),
          .bytes_per_image = info.max_allocation_bytes,
          .side_2d = info.limits.maxImageDimension2D,
          .side_3d = info.limits.maxImageDimension3D,
          .layers = info.limits.maxImageArrayLayers};
}

void require_room(const Graph& graph, const DeviceRoom& room) {
  for (const Value& value : graph.values) require_image(value, room);
  const Share volumes = share_of(graph, true);
  const Share pictures = share_of(graph, false);
  const uint64_t needed = volumes.bytes + pictures.bytes;
  if (needed <= room.bytes) return;
  refuse("the images of this graph need " + gpu::bytes_text(needed) + ", more than the " + gpu::bytes_text(room.bytes) +
             " that device '" + room.device + "' has left; voxel grids take " + gpu::bytes_text(volumes.bytes) +
             " of it, pictures with their histories " + gpu::bytes_text(pictures.bytes),
         lower_all(volumes, pictures, room.bytes));
}

}  // namespace lightloom::run
