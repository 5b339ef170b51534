#include "framework/run/scene_accelerator.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "framework/gpu/transfer.hpp"
#include "framework/scene/spatial_order.hpp"

namespace lightloom::run {
namespace {

constexpr size_t kGroups = 4;

bool is_masked(size_t group) {
  return group % 2 == 1;
}
bool moves(size_t group) {
  return group >= 2;
}

using Groups = std::array<std::vector<uint32_t>, kGroups>;

/// Indices of triangles by group.
Groups group_triangles(const scene::Scene& scene) {
  Groups groups;
  for (uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const bool masked = scene.materials[scene.triangles[t].material].alpha_mode == scene::AlphaMode::mask;
    const bool dynamic = t >= scene.static_triangle_count;
    groups[(dynamic ? 2 : 0) + (masked ? 1 : 0)].push_back(t);
  }
  // Lavapipe's trees split the list of triangles in the middle, whatever they are; other drivers sort for themselves.
  for (std::vector<uint32_t>& group : groups) scene::order_in_space(scene, group);
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

static_assert(offsetof(scene::Vertex, position) == 0, "builds read positions from the start of a vertex");

}  // namespace

SceneAccelerator::SceneAccelerator(gpu::Device& device, const scene::Scene& scene, const gpu::Buffer& vertices)
    : SceneAccelerator(device, scene, vertices, group_triangles(scene)) {}

SceneAccelerator::SceneAccelerator(gpu::Device& device, const scene::Scene& scene, const gpu::Buffer& vertices,
                                   const Groups& groups)
    : primitives_(upload(device, primitive_list(groups), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "order of the triangles")),
      indices_(upload(device, index_list(scene, groups), gpu::kBuildInputUsage, "corners of the triangles")) {
  std::vector<VkAccelerationStructureInstanceKHR> instances;
  uint32_t first = 0;
  for (uint32_t group = 0; group < kGroups; ++group) {
    const auto count = static_cast<uint32_t>(groups[group].size());
    if (count == 0) continue;
    const gpu::TriangleGeometry geometry{.vertices = &vertices,
                                         .vertex_stride = sizeof(scene::Vertex),
                                         .vertex_count = static_cast<uint32_t>(scene.vertices.size()),
                                         .indices = &indices_,
                                         .first_triangle = first,
                                         .triangle_count = count,
                                         .opaque = !is_masked(group)};
    std::list<gpu::AccelerationStructure>& target = moves(group) ? dynamic_ : static_;
    target.emplace_back(device, std::span(&geometry, 1), moves(group) ? gpu::Rebuilding::often : gpu::Rebuilding::never,
                        std::string("the ") + (moves(group) ? "dynamic" : "static") +
                            (is_masked(group) ? " alpha-masked" : "") + " triangles");
    instances.push_back(gpu::make_instance(target.back(), group));
    first += count;
  }
  const std::span<const std::byte> bytes = std::as_bytes(std::span(instances));
  instances_.emplace(device, std::max(bytes.size(), sizeof(VkAccelerationStructureInstanceKHR)), gpu::kBuildInputUsage,
                     gpu::MemoryKind::upload, "instances");
  std::copy(bytes.begin(), bytes.end(), instances_->mapped().begin());
  top_.emplace(device, *instances_, static_cast<uint32_t>(instances.size()),
               !dynamic_.empty() ? gpu::Rebuilding::often : gpu::Rebuilding::never, "the scene");
  build_what_rests(device);
}

void SceneAccelerator::build_what_rests(gpu::Device& device) {
  device.run_commands([&](VkCommandBuffer commands) {
    gpu::record_full_barrier(commands);
    for (const gpu::AccelerationStructure& structure : static_) structure.record_build(commands);
    gpu::record_full_barrier(commands);
    if (dynamic_.empty()) top_->record_build(commands);
    gpu::record_full_barrier(commands);
  });
  for (gpu::AccelerationStructure& structure : static_) structure.release_scratch();
  if (dynamic_.empty()) top_->release_scratch();
}

void SceneAccelerator::record_rebuild(VkCommandBuffer commands) const {
  if (dynamic_.empty()) return;
  gpu::record_full_barrier(commands);
  for (const gpu::AccelerationStructure& structure : dynamic_) structure.record_build(commands);
  gpu::record_full_barrier(commands);
  top_->record_build(commands);
  gpu::record_full_barrier(commands);
}

}  // namespace lightloom::run
