#include "passes/voxel_boxes.hpp"

#include <utility>

#include "passes/param_rows.hpp"

namespace lightloom::passes {

Param update_param() {
  return choice_param("update", "moved", {"moved", "all"},
                      "what a frame rewrites: the voxels around what moved, or all; the result is the same as long as "
                      "voxels change only where the scene's triangles do");
}

std::vector<VoxelBox> boxes_to_update(const PassContext& context, const Extent3& grid, bool kept, int32_t margin) {
  const VoxelBox whole = whole_grid(grid);
  if (!kept || context.params().choice("update") == "all") return {whole};
  const std::vector<VoxelBox> moved = context.moved_boxes(grid);
  if (volume(widened(moved, {margin, margin, margin}, grid)) * 2 > volume(whole)) return {whole};
  return moved;
}

std::vector<VoxelBox> widened(const std::vector<VoxelBox>& boxes, const std::array<int32_t, 3>& margin,
                              const Extent3& grid) {
  std::vector<VoxelBox> wide;
  wide.reserve(boxes.size());
  for (const VoxelBox& box : boxes) wide.push_back(dilated(box, margin, grid));
  return merged(wide, wide.size());
}

Dispatch box_dispatch(std::string shader, const VoxelBox& box, std::vector<ShaderValue> values, uint32_t run) {
  const std::array<const char*, 3> low = {"box_low_x", "box_low_y", "box_low_z"};
  const std::array<const char*, 3> high = {"box_high_x", "box_high_y", "box_high_z"};
  std::array<uint32_t, 3> size{};
  for (size_t axis = 0; axis < 3; ++axis) {
    values.push_back({low[axis], box.low[axis]});
    values.push_back({high[axis], box.high[axis]});
    size[axis] = static_cast<uint32_t>(box.high[axis] - box.low[axis] + 1);
  }
  return {std::move(shader), {size[0], size[1], (size[2] + run - 1) / run}, std::move(values)};
}

}  // namespace lightloom::passes
