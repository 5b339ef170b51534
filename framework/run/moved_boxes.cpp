#include "framework/run/moved_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/graph/voxel_box.hpp"
#include "framework/run/grid.hpp"

namespace lightloom::run {
namespace {

constexpr size_t kMostBoxes = 16;

scene::Bounds bounds_of(std::span<const scene::Vertex> vertices) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  scene::Bounds bounds{glm::vec3(kInfinity), glm::vec3(-kInfinity)};
  for (const scene::Vertex& vertex : vertices) {
    // fmin and fmax pass over what is no number.
    for (int axis = 0; axis < 3; ++axis) {
      bounds.min[axis] = std::fmin(bounds.min[axis], vertex.position[axis]);
      bounds.max[axis] = std::fmax(bounds.max[axis], vertex.position[axis]);
    }
  }
  return bounds;
}

/// Empty (high below low) where the bounds lie outside the grid. Compared as floats: far corners do not fit integers.
VoxelBox voxels_within(const Grid& grid, const scene::Bounds& bounds) {
  const glm::vec3 low = (bounds.min - grid.origin) / grid.voxel;
  const glm::vec3 high = (bounds.max - grid.origin) / grid.voxel;
  const glm::vec3 extent(grid.extent.width, grid.extent.height, grid.extent.depth);
  VoxelBox box;
  for (int axis = 0; axis < 3; ++axis) {
    // A voxel is touched at its upper face too, hence ceil - 1.
    const float first = std::max(std::ceil(low[axis]) - 2.0f, 0.0f);
    const float last = std::min(std::floor(high[axis]) + 1.0f, extent[axis] - 1.0f);
    if (!(first <= last)) return {};
    box.low[static_cast<size_t>(axis)] = static_cast<int32_t>(first);
    box.high[static_cast<size_t>(axis)] = static_cast<int32_t>(last);
  }
  return box;
}

}  // namespace

MovingObjects::MovingObjects(const scene::Scene& scene) {
  for (size_t i = scene.static_triangle_count; i < scene.triangles.size();) {
    const uint32_t object = scene.triangles[i].object;
    uint32_t first = std::numeric_limits<uint32_t>::max();
    uint32_t last = 0;
    for (; i < scene.triangles.size() && scene.triangles[i].object == object; ++i) {
      const scene::Triangle& t = scene.triangles[i];
      first = std::min({first, t.a, t.b, t.c});
      last = std::max({last, t.a, t.b, t.c});
    }
    objects_.push_back({first - scene.static_vertex_count, last - first + 1});
  }
}

void MovingObjects::update(std::span<const scene::Vertex> vertices) {
  moved_.clear();
  for (const Object& object : objects_) {
    const std::span<const scene::Vertex> now = vertices.subspan(object.first, object.count);
    if (!previous_.empty()) {
      const std::span<const scene::Vertex> before = std::span(previous_).subspan(object.first, object.count);
      if (std::ranges::equal(std::as_bytes(now), std::as_bytes(before))) continue;
      moved_.push_back(bounds_of(before));
    }
    moved_.push_back(bounds_of(now));
  }
  previous_.assign(vertices.begin(), vertices.end());
}

std::vector<VoxelBox> moved_boxes(const scene::Bounds& scene, const Extent3& grid,
                                  const std::vector<scene::Bounds>& moved) {
  const Grid around = grid_around(scene.min, scene.max, grid);
  std::vector<VoxelBox> boxes;
  boxes.reserve(moved.size());
  for (const scene::Bounds& bounds : moved) boxes.push_back(voxels_within(around, bounds));
  return merged(boxes, kMostBoxes);
}

}  // namespace lightloom::run
