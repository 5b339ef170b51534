#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "framework/graph/pass_context.hpp"

namespace lightloom {

/// Number of voxels; 0 for a box whose `high` lies below its `low` on some axis.
[[nodiscard]] int64_t volume(const VoxelBox& box);
[[nodiscard]] int64_t volume(const std::vector<VoxelBox>& boxes);  ///< sum over the boxes

[[nodiscard]] VoxelBox whole_grid(const Extent3& grid);
[[nodiscard]] bool overlap(const VoxelBox& a, const VoxelBox& b);
/// The least box that holds both.
[[nodiscard]] VoxelBox united(const VoxelBox& a, const VoxelBox& b);
/// Widened by `margin` voxels on both sides of each axis, as far as the grid reaches.
[[nodiscard]] VoxelBox dilated(const VoxelBox& box, const std::array<int32_t, 3>& margin, const Extent3& grid);

/// Disjoint boxes, at most `limit` (at least 1) of them, that hold all of `boxes`. Boxes become one where they overlap,
/// where the union is no larger than both together, and, for the limit, where it adds the fewest voxels.
[[nodiscard]] std::vector<VoxelBox> merged(const std::vector<VoxelBox>& boxes, size_t limit);

}  // namespace lightloom
