#include "passes/moved_voxels.hpp"

#include <cstdint>

#include "passes/port_rows.hpp"
#include "passes/voxel_boxes.hpp"

namespace lightloom::passes {
namespace {

constexpr Extent3 kBoxesExtent{2, 16, 1};  // as many as PassContext::moved_boxes names at most

void record(PassContext& context) {
  context.clear("moved", {0, 0, 0, 0});
  const Extent3 grid = context.input_extent("voxels");
  int32_t row = 0;
  // What leaves a voxel exposes faces of those around it.
  for (const VoxelBox& box : widened(context.moved_boxes(grid), {1, 1, 1}, grid)) {
    Dispatch dispatch = box_dispatch("moved_voxels.comp", box, {{"row", row++}});
    dispatch.threads = {1, 1, 1};
    context.dispatch(dispatch);
  }
}

}  // namespace

PassType make_moved_voxels() {
  PassType type;
  type.name = "moved_voxels";
  type.doc = "Names the voxels whose exposed faces may differ from a frame ago, for those who use what they knew then.";
  Port moved;
  moved.name = "moved";
  moved.direction = Direction::out;
  moved.parts = {{"", Format::rgba32_uint, ""}};
  moved.extent = ExtentRule::fixed;
  moved.fixed_extent = kBoxesExtent;
  moved.access = Access::compute_storage_write;
  moved.doc = "a box in each row: its first voxel, and the one past its last; 0 in the rows after the last box";
  type.ports = {voxels_input("voxels", "the grid"), moved};
  type.reads = FrameState::dynamic_geometry;
  type.record = record;
  return type;
}

}  // namespace lightloom::passes
