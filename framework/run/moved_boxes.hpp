#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "framework/graph/pass_context.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::run {

/// Follows the moving objects of a scene from frame to frame.
class MovingObjects {
 public:
  explicit MovingObjects(const scene::Scene& scene);

  /// Takes the dynamic vertices of a new frame (Pose::dynamic_vertices).
  void update(std::span<const scene::Vertex> vertices);

  /// Boxes [m] around every object whose vertices differ in any bit from those of the frame before: as it was, and as
  /// it is. After the first frame: around every object. Corners that are no numbers do not count.
  [[nodiscard]] const std::vector<scene::Bounds>& moved() const { return moved_; }

 private:
  struct Object {
    uint32_t first = 0;  ///< into the dynamic vertices
    uint32_t count = 0;
  };
  std::vector<Object> objects_;
  std::vector<scene::Vertex> previous_;
  std::vector<scene::Bounds> moved_;
};

/// The voxels of a grid of `grid` voxels around the scene's bounds [m] that triangles within the boxes `moved` [m] may
/// touch, with one voxel more on every side, clipped to the grid: at most 16 disjoint boxes.
[[nodiscard]] std::vector<VoxelBox> moved_boxes(const scene::Bounds& scene, const Extent3& grid,
                                                const std::vector<scene::Bounds>& moved);

}  // namespace lightloom::run
