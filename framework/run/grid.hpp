#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "framework/graph/desc.hpp"

namespace lightloom::run {

/// The voxel grid of a scene: `extent` cubes of edge `voxel` [m] from `origin` on, axes along the world's.
struct Grid {
  glm::vec3 origin{0};
  float voxel = 1;
  Extent3 extent;
};

/// Grid around the bounds [m]: the longest axis has `resolution` voxels (at least 3), one voxel of padding at each end
/// included; the other axes as many as their length needs (at least one), and the same padding. The bounds lie in the
/// middle. Bounds that are a point, or too small for floats to resolve at their distance from the world's origin, get
/// one voxel and the padding; components that are not finite count as 0.
/// shaders/lib/grid.glsl computes the same from the bounds and the extent.
[[nodiscard]] Grid make_grid(glm::vec3 bounds_min, glm::vec3 bounds_max, uint32_t resolution);

/// The grid of `extent` voxels, as make_grid chose it, around the same bounds [m]; the numbers are those of the
/// shaders.
[[nodiscard]] Grid grid_around(glm::vec3 bounds_min, glm::vec3 bounds_max, const Extent3& extent);

[[nodiscard]] Extent3 grid_extent(glm::vec3 bounds_min, glm::vec3 bounds_max, uint32_t resolution);

}  // namespace lightloom::run
