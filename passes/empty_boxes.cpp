#include "passes/empty_boxes.hpp"

#include "passes/port_rows.hpp"

namespace lightloom::passes {
namespace {

Port boxes_output() {
  Port port = many_times(
      kBoxBlocks,
      image_output_like(
          "boxes", Format::r32_uint, "distance",
          "edges of an empty box [voxels, at most 31] with this voxel in its near corner: 5 bits each, x lowest; all 0 "
          "in an occupied voxel. Low half: for directions that rise along x, high half: fall. The voxels for those "
          "that fall along y or z are a grid further along y or z"));
  port.dimension = Dimension::d3;
  port.access = Access::compute_storage_read_write;
  port.exact_format = "it holds packed whole numbers";
  return port;
}

/// One thread for each row of voxels along the axis and for each sign of y and z.
void record(PassContext& context) {
  constexpr uint32_t kSigns = 4;
  const Extent3 boxes = context.output_extent("boxes");
  const Extent3 grid{boxes.width / kBoxBlocks.width, boxes.height / kBoxBlocks.height, boxes.depth / kBoxBlocks.depth};
  context.dispatch({"empty_boxes.comp", {grid.height, grid.depth, kSigns}, {{"axis", 0}}});
  context.dispatch({"empty_boxes.comp", {grid.width, grid.depth, kSigns}, {{"axis", 1}}});
  context.dispatch({"empty_boxes.comp", {grid.width, grid.height, kSigns}, {{"axis", 2}}});
}

}  // namespace

PassType make_empty_boxes() {
  PassType type;
  type.name = "empty_boxes";
  type.doc =
      "Empty boxes ahead of each voxel, for rays that step through the grid from box to box (`march` box_exit). A ray "
      "never turns back along an axis, so what lies behind it need not be empty and a box may be long where a cube "
      "around the voxel would be small: along walls. From the cubes that `distance` promises, boxes grow along x, y "
      "and z in turn: a voxel's box and the one of its neighbour ahead share their cross-section and add up in "
      "length, if that makes the box larger in the harmonic mean of its edges. Costs 16 bytes a voxel, and has to be "
      "made anew as a whole when anything moves.";
  Port distance = volume_input("distance", "chessboard distance to the nearest occupied voxel [voxels / 255], capped");
  type.ports = {distance, boxes_output()};
  type.record = record;
  return type;
}

}  // namespace lightloom::passes
