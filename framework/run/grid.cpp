#include "framework/run/grid.hpp"

#include <algorithm>
#include <cmath>

namespace lightloom::run {
namespace {

// A float resolves 6e-8 of its magnitude: bounds smaller than a few such steps are a point.
constexpr float kResolvable = 1e-6f;
constexpr float kLeastLength = 1e-20f;

glm::vec3 finite_or_zero(glm::vec3 value) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(value[axis])) value[axis] = 0;
  }
  return value;
}

float largest(glm::vec3 value) {
  return std::max({value.x, value.y, value.z});
}

uint32_t voxels_along(float length, float voxel, uint32_t resolution) {
  const float inner = std::ceil(length / voxel);
  return static_cast<uint32_t>(std::clamp(inner, 1.0f, static_cast<float>(resolution - 2))) + 2;
}

}  // namespace

Grid make_grid(glm::vec3 bounds_min, glm::vec3 bounds_max, uint32_t resolution) {
  resolution = std::max(resolution, 3u);
  const glm::vec3 low = finite_or_zero(bounds_min);
  const glm::vec3 high = glm::max(finite_or_zero(bounds_max), low);
  const glm::vec3 size = high - low;
  const float magnitude = largest(glm::max(glm::abs(low), glm::abs(high)));
  const float longest = std::max({largest(size), magnitude * kResolvable, kLeastLength});

  Grid grid;
  grid.voxel = longest / static_cast<float>(resolution - 2);
  grid.extent = {voxels_along(size.x, grid.voxel, resolution), voxels_along(size.y, grid.voxel, resolution),
                 voxels_along(size.z, grid.voxel, resolution)};
  if (largest(size) < longest) {
    grid.voxel = longest;
    grid.extent = {3, 3, 3};
  }
  const glm::vec3 voxels(grid.extent.width, grid.extent.height, grid.extent.depth);
  grid.origin = 0.5f * (low + high) - 0.5f * grid.voxel * voxels;
  return grid;
}

Grid grid_around(glm::vec3 bounds_min, glm::vec3 bounds_max, const Extent3& extent) {
  const glm::vec3 low = bounds_min;
  const glm::vec3 high = glm::max(bounds_max, low);
  const float magnitude = largest(glm::max(glm::abs(low), glm::abs(high)));
  const float longest = std::max({largest(high - low), magnitude * kResolvable, kLeastLength});
  const glm::vec3 voxels(extent.width, extent.height, extent.depth);
  Grid grid;
  grid.extent = extent;
  grid.voxel = longest / std::max(largest(voxels) - 2.0f, 1.0f);
  grid.origin = 0.5f * (low + high) - 0.5f * grid.voxel * voxels;
  return grid;
}

Extent3 grid_extent(glm::vec3 bounds_min, glm::vec3 bounds_max, uint32_t resolution) {
  return make_grid(bounds_min, bounds_max, resolution).extent;
}

}  // namespace lightloom::run
