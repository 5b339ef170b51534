#pragma once

#include <optional>
#include <span>

#include "framework/reference/geometry.hpp"
#include "framework/reference/voxel_emitters.hpp"
#include "framework/reference/voxel_grid.hpp"

namespace lightloom::reference {

/// What a voxel path tracer makes of a scene, without its noise and without its steps: paths start at a triangle and go
/// on from voxel to voxel. A voxel is met wherever a ray touches it, with the normal, material and emission that it
/// holds, turned to where the ray came from. Rays leave a triangle at |x| + |y| + |z| voxels along its normal, which is
/// clear of the voxels of its plane, and a voxel at one and a half times that from the plane through its centre.
/// Lobes of voxels are at least 0.03 wide, as sharper ones would show how coarse the normals are stored.
class VoxelGeometry {
 public:
  using Hit = VoxelGrid::Hit;

  /// As VoxelGrid and VoxelEmitters; keeps references to what the spans show.
  VoxelGeometry(const VoxelImages& images, const scene::Bounds& bounds, std::span<const scene::EmissionEntry> entries,
                std::span<const float> areas = {});
  VoxelGeometry(const VoxelGeometry&) = delete;
  VoxelGeometry& operator=(const VoxelGeometry&) = delete;
  ~VoxelGeometry() = default;

  [[nodiscard]] std::optional<Hit> closest_hit(const Ray& ray) const;
  [[nodiscard]] SurfacePoint surface(const Ray& ray, const Hit& hit) const;
  [[nodiscard]] LightHit emission(const SurfacePoint& from, const Ray& ray, const Hit& hit) const;
  [[nodiscard]] bool emits() const { return !emitters_.empty(); }
  [[nodiscard]] LightSample sample_emitter(const SurfacePoint& from, const glm::vec2& pick,
                                           const glm::vec2& point) const;
  /// A shadow ray to a point light ends sqrt(3) voxels before it, where the voxels of its lamp begin.
  [[nodiscard]] bool occluded(const SurfacePoint& from, const LightSample& light) const;
  [[nodiscard]] SurfacePoint start(const SurfacePoint& first) const;

  [[nodiscard]] const VoxelGrid& grid() const { return grid_; }

 private:
  VoxelGrid grid_;
  VoxelEmitters emitters_;
};
static_assert(Geometry<VoxelGeometry>);

}  // namespace lightloom::reference
