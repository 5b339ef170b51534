#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "framework/graph/pass_context.hpp"
#include "framework/graph/voxel_box.hpp"

// For passes over the voxel grid that rewrite only what moved.
namespace lightloom::passes {

/// The param `update`: `moved` or `all`.
[[nodiscard]] Param update_param();

/// Boxes of a grid of `grid` voxels in which an output may differ from a frame ago, disjoint: those that
/// PassContext::moved_boxes names. The whole grid if `kept` is false, if the param `update` says `all`, and where the
/// boxes, `margin` voxels wider on every side, hold more than half of it.
[[nodiscard]] std::vector<VoxelBox> boxes_to_update(const PassContext& context, const Extent3& grid, bool kept,
                                                    int32_t margin = 0);

/// Every box `margin` voxels wider, and disjoint again.
[[nodiscard]] std::vector<VoxelBox> widened(const std::vector<VoxelBox>& boxes, const std::array<int32_t, 3>& margin,
                                            const Extent3& grid);

/// One invocation for each voxel of the box, or, with `run` above 1, for `run` voxels in a row along z; the shader
/// finds its voxel by shaders/lib/box.glsl.
[[nodiscard]] Dispatch box_dispatch(std::string shader, const VoxelBox& box, std::vector<ShaderValue> values = {},
                                    uint32_t run = 1);

}  // namespace lightloom::passes
