#include "framework/run/device_room.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/error.hpp"
#include "framework/gpu/memory.hpp"
#include "framework/run/scene_layout.hpp"
#include "framework/scene/gpu_material.hpp"

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

/// What to lower so that the demand fits: the larger of grids and pictures, if the other one and the scene fit.
std::string lower_demand(const Graph& graph, const MemoryDemand& demand, uint64_t available) {
  if (demand.bytes() <= available)
    return "something else uses the device's memory, or it is in pieces: end that, or choose a smaller --size or "
           "resolution";
  const uint64_t pictures = demand.pictures + demand.readback;
  const auto fraction = [&](uint64_t part) {
    const uint64_t others = demand.bytes() - part;
    return others >= available ? 0.0 : static_cast<double>(available - others) / static_cast<double>(part);
  };
  if (demand.volumes >= pictures && demand.volumes > 0) {
    const auto fitting = static_cast<uint32_t>(std::cbrt(fraction(demand.volumes)) * share_of(graph, true).longest);
    if (fitting >= kLeastResolution) return "lower the param 'resolution' to " + std::to_string(fitting) + " or less";
  }
  const double scale = pictures > 0 ? std::sqrt(fraction(pictures)) : 0;
  const auto width = static_cast<uint32_t>(scale * graph.view.width);
  const auto height = static_cast<uint32_t>(scale * graph.view.height);
  if (width > 0 && height > 0)
    return "choose --size " + std::to_string(width) + "x" + std::to_string(height) +
           " or less, a shorter history, or a narrower format with --store";
  if (demand.geometry + demand.textures >= available)
    return "the scene alone is too large for this device: choose one with more memory";
  return "lower both --size and the param 'resolution', or choose a device with more memory";
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

MemoryDemand demand_of(const Graph& graph, const scene::Scene& scene) {
  constexpr uint64_t kFramesHeld = 3;  // one rendered, one written, one that waits for that
  constexpr uint64_t kTexel = 4;       // of a texture page
  MemoryDemand demand{.volumes = share_of(graph, true).bytes, .pictures = share_of(graph, false).bytes};
  for (const GraphOutput& output : graph.outputs)
    demand.readback += kFramesHeld * byte_size(graph.values[output.value].desc);
  for (const ValueId capture : graph.captures) demand.readback += kFramesHeld * byte_size(graph.values[capture].desc);
  const uint64_t moving = scene.vertices.size() - scene.static_vertex_count;
  constexpr uint64_t kPosition = sizeof(glm::vec4);
  demand.geometry = scene.vertices.size() * sizeof(scene::Vertex) + scene.triangles.size() * sizeof(scene::Triangle) +
                    scene.materials.size() * sizeof(scene::GpuMaterial) +
                    moving * (sizeof(scene::Vertex) + (kHistoryLimit + 1) * kPosition);
  for (const scene::Image& image : scene.images)
    demand.textures += kTexel * image.width * image.height * 4 / 3;  // the mip levels: a third
  demand.textures += scene.environment.rgb.size() / 3 * sizeof(glm::vec4);
  return demand;
}

gpu::OutOfMemory with_demand(const gpu::OutOfMemory& error, const Graph& graph, const MemoryDemand& demand,
                             const DeviceRoom& room) {
  const std::string sentence = std::string(error.what()) + "; the whole run needs " + gpu::bytes_text(demand.bytes()) +
                               ": voxel grids " + gpu::bytes_text(demand.volumes) + ", pictures with their histories " +
                               gpu::bytes_text(demand.pictures) + ", their copies for files " +
                               gpu::bytes_text(demand.readback) + ", the scene's geometry " +
                               gpu::bytes_text(demand.geometry) + " and textures " + gpu::bytes_text(demand.textures) +
                               "; before it the device had " + gpu::bytes_text(room.bytes);
  return gpu::OutOfMemory(sentence, lower_demand(graph, demand, room.bytes));
}

}  // namespace lightloom::run
