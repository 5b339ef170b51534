#include "framework/run/scene_accelerator.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "framework/gpu/transfer.hpp"

namespace lightloom::run {
namespace {

constexpr size_t kGroups = 4;
constexpr uint32_t kStaticGroups = 0;
constexpr uint32_t kDynamicGroups = 2;

using Groups = std::array<std::vector<uint32_t>, kGroups>;

/// Indices of triangles by group.
Groups group_triangles(const scene::Scene& scene) {
  Groups groups;
  for (uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const bool masked = scene.materials[scene.triangles[t].material].alpha_mode == scene::AlphaMode::mask;
    const uint32_t first = t < scene.static_triangle_count ? kStaticGroups : kDynamicGroups;
    groups[first + (masked ? 1 : 0)].push_back(t);
  }
  return groups;
}

/// Where each group starts in PrimitiveBlock, then the groups one after another.
std::vector<uint32_t> primitive_list(const Groups& groups) {
  std::vector<uint32_t> list;
  auto first = static_cast<uint32_t>(kGroups);
  for (const std::vector<uint32_t>& group : groups) {
    list.push_back(first);
    first += static_cast<uint32_t>(group.size());
  }
  for (const std::vector<uint32_t>& group : groups) list.insert(list.end(), group.begin(), group.end());
  return list;
}

/// Corners of the triangles in the order of the groups.
std::vector<uint32_t> index_list(const scene::Scene& scene, const Groups& groups) {
  std::vector<uint32_t> list;
  for (const std::vector<uint32_t>& group : groups)
    for (const uint32_t t : group)
      for (const uint32_t corner : {scene.triangles[t].a, scene.triangles[t].b, scene.triangles[t].c})
        list.push_back(corner);
  if (list.empty()) list.push_back(0);
  return list;
}

gpu::Buffer upload(gpu::Device& device, const std::vector<uint32_t>& list, VkBufferUsageFlags usage, const char* name) {
  const std::span<const std::byte> bytes = std::as_bytes(std::span(list));
  gpu::Buffer buffer(device, bytes.size(), usage, gpu::MemoryKind::device, name);
  gpu::upload_buffer(device, buffer, bytes);
  return buffer;
}

/// The two geometries, opaque and masked, of what is static or what moves; both are there, even if empty, so that the
/// index of a geometry says which it is.
std::array<gpu::TriangleGeometry, 2> geometries(const scene::Scene& scene, const gpu::Buffer& vertices,
                                                const gpu::Buffer& indices, const Groups& groups, uint32_t first) {
  std::array<gpu::TriangleGeometry, 2> pair;
  uint32_t before = 0;
  for (uint32_t g = 0; g < first; ++g) before += static_cast<uint32_t>(groups[g].size());
  for (uint32_t kind = 0; kind < 2; ++kind) {
    const auto count = static_cast<uint32_t>(groups[first + kind].size());
    pair[kind] = {.vertices = &vertices,
                  .vertex_stride = sizeof(scene::Vertex),
                  .vertex_count = static_cast<uint32_t>(scene.vertices.size()),
                  .indices = &indices,
                  .first_triangle = before,
                  .triangle_count = count,
                  .opaque = kind == 0};
    before += count;
  }
  return pair;
}
static_assert(offsetof(scene::Vertex, position) == 0, "builds read positions from the start of a vertex");

}  // namespace

SceneAccelerator::SceneAccelerator(gpu::Device& device, const scene::Scene& scene, const gpu::Buffer& vertices)
    : SceneAccelerator(device, scene, vertices, group_triangles(scene)) {}

SceneAccelerator::SceneAccelerator(gpu::Device& device, const scene::Scene& scene, const gpu::Buffer& vertices,
                                   const Groups& groups)
    : primitives_(upload(device, primitive_list(groups), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "order of the triangles")),
      indices_(upload(device, index_list(scene, groups), gpu::kBuildInputUsage, "corners of the triangles")) {
  std::vector<VkAccelerationStructureInstanceKHR> instances;
  if (scene.static_triangle_count > 0) {
    static_.emplace(device, geometries(scene, vertices, indices_, groups, kStaticGroups), gpu::Rebuilding::never,
                    "the static triangles");
    instances.push_back(gpu::make_instance(*static_, kStaticGroups));
  }
  if (scene.static_triangle_count < scene.triangles.size()) {
    dynamic_.emplace(device, geometries(scene, vertices, indices_, groups, kDynamicGroups), gpu::Rebuilding::often,
                     "the dynamic triangles");
    instances.push_back(gpu::make_instance(*dynamic_, kDynamicGroups));
  }
  const std::span<const std::byte> bytes = std::as_bytes(std::span(instances));
  instances_.emplace(device, std::max(bytes.size(), sizeof(VkAccelerationStructureInstanceKHR)), gpu::kBuildInputUsage,
                     gpu::MemoryKind::upload, "instances");
  std::copy(bytes.begin(), bytes.end(), instances_->mapped().begin());
  top_.emplace(device, *instances_, static_cast<uint32_t>(instances.size()),
               dynamic_ ? gpu::Rebuilding::often : gpu::Rebuilding::never, "the scene");
  build_what_rests(device);
}

void SceneAccelerator::build_what_rests(gpu::Device& device) {
  device.run_commands([&](VkCommandBuffer commands) {
    gpu::record_full_barrier(commands);
    if (static_) static_->record_build(commands);
    gpu::record_full_barrier(commands);
    if (!dynamic_) top_->record_build(commands);
    gpu::record_full_barrier(commands);
  });
  if (static_) static_->release_scratch();
  if (!dynamic_) top_->release_scratch();
}

void SceneAccelerator::record_rebuild(VkCommandBuffer commands) const {
  if (!dynamic_) return;
  gpu::record_full_barrier(commands);
  dynamic_->record_build(commands);
  gpu::record_full_barrier(commands);
  top_->record_build(commands);
  gpu::record_full_barrier(commands);
}

}  // namespace lightloom::run
