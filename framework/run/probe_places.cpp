#include "framework/run/probe_places.hpp"

#include <algorithm>

#include "framework/run/grid.hpp"

namespace lightloom::run {
namespace {

/// floor((pixel + 1/2) size / view) in whole numbers.
uint32_t scaled(uint32_t pixel, uint32_t size, uint32_t view) {
  return static_cast<uint32_t>((uint64_t{pixel} * 2 + 1) * size / (uint64_t{view} * 2));
}

bool is_scene_grid(const Extent3& extent, const scene::Bounds& bounds) {
  const uint32_t resolution = std::max({extent.width, extent.height, extent.depth});
  return grid_extent(bounds.min, bounds.max, resolution) == extent;
}

}  // namespace

std::array<uint32_t, 3> texel_at(const Extent3& extent, const Extent3& view, uint32_t x, uint32_t y) {
  return {scaled(x, extent.width, view.width), scaled(y, extent.height, view.height), 0};
}

ProbePlace voxel_at(const Extent3& extent, const scene::Bounds& bounds, const glm::vec3& point) {
  if (!is_scene_grid(extent, bounds)) return {.missing = "it is no voxel grid of the scene"};
  const Grid grid = grid_around(bounds.min, bounds.max, extent);
  const glm::vec3 cell = glm::floor((point - grid.origin) / grid.voxel);
  const glm::vec3 size(extent.width, extent.height, extent.depth);
  ProbePlace place;
  for (int axis = 0; axis < 3; ++axis) {
    // Written so that a coordinate which is no number is outside.
    if (!(cell[axis] >= 0 && cell[axis] < size[axis])) return {.missing = "the point lies outside its grid"};
    place.texel[static_cast<size_t>(axis)] = static_cast<uint32_t>(cell[axis]);
  }
  return place;
}

std::optional<ValueId> surface_position(const Graph& graph, const std::vector<bool>& watched) {
  std::optional<ValueId> best;
  const auto texels = [&](ValueId id) {
    return uint64_t{graph.values[id].desc.extent.width} * graph.values[id].desc.extent.height;
  };
  for (ValueId id = 0; id < graph.values.size(); ++id) {
    const Value& value = graph.values[id];
    if (!watched[id] || value.part != "position" || value.port.find("surface") == std::string::npos ||
        value.desc.dimension != Dimension::d2 || value.desc.format != Format::rgba32_sfloat)
      continue;
    if (!best || texels(id) > texels(*best)) best = id;
  }
  return best;
}

}  // namespace lightloom::run
