#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "framework/graph/graph.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::run {

/// Which texel of a value stands for a pixel.
struct ProbePlace {
  std::array<uint32_t, 3> texel{0, 0, 0};
  std::string missing;  ///< why there is none; empty if there is one
};

/// The texel of an image of `extent` that covers the centre of pixel (x, y) of a view.
[[nodiscard]] std::array<uint32_t, 3> texel_at(const Extent3& extent, const Extent3& view, uint32_t x, uint32_t y);

/// The voxel of a grid of `extent` around the scene's bounds that holds a point [m].
[[nodiscard]] ProbePlace voxel_at(const Extent3& extent, const scene::Bounds& bounds, const glm::vec3& point);

/// The value that says which point each pixel sees: the part `position` of a surface, the largest of them, the first
/// of equals; only values in `watched` (one entry a value) count.
[[nodiscard]] std::optional<ValueId> surface_position(const Graph& graph, const std::vector<bool>& watched);

}  // namespace lightloom::run
