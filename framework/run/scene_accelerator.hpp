#pragma once

#include <array>
#include <cstdint>
#include <list>
#include <optional>
#include <vector>

#include "framework/gpu/acceleration_structure.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::run {

/// The scene's triangles for ray queries: structures of those that never move, built once, of the others, built in
/// every frame, and one over all. Alpha-masked triangles have structures of their own, as only they ask the shader.
class SceneAccelerator {
 public:
  /// `vertices`: all of the scene's, on the device, with gpu::kBuildInputUsage among its usages; the static ones are
  /// already there. Throws Error(invalid_input) for more triangles than the device takes.
  SceneAccelerator(gpu::Device& device, const scene::Scene& scene, const gpu::Buffer& vertices);

  /// Records the build of what moves, after the upload of its vertices, and makes it visible to shaders.
  void record_rebuild(VkCommandBuffer commands) const;

  [[nodiscard]] VkAccelerationStructureKHR top_level() const { return top_->get(); }
  /// `PrimitiveBlock` of shaders/lib/ray_scene.glsl.
  [[nodiscard]] const gpu::Buffer& primitives() const { return primitives_; }

 private:
  /// Indices of triangles: static opaque, static masked, dynamic opaque, dynamic masked.
  using Groups = std::array<std::vector<uint32_t>, 4>;
  SceneAccelerator(gpu::Device& device, const scene::Scene& scene, const gpu::Buffer& vertices, const Groups& groups);
  void build_what_rests(gpu::Device& device);

  gpu::Buffer primitives_;
  gpu::Buffer indices_;
  std::list<gpu::AccelerationStructure> static_;
  std::list<gpu::AccelerationStructure> dynamic_;
  std::optional<gpu::Buffer> instances_;
  std::optional<gpu::AccelerationStructure> top_;
};

}  // namespace lightloom::run
