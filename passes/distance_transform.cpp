#include "passes/distance_transform.hpp"

#include "passes/param_rows.hpp"
#include "passes/port_rows.hpp"
#include "passes/voxel_boxes.hpp"

namespace lightloom::passes {
namespace {

Port volume(const std::string& name, Direction direction, Access access, const std::string& doc) {
  Port port = image_output_like(name, Format::r8_unorm, "voxels", doc);
  port.direction = direction;
  port.dimension = Dimension::d3;
  port.access = access;
  port.persistent = true;
  return port;
}

Port scratch_volume(const std::string& name, const std::string& doc) {
  return volume(name, Direction::scratch, Access::compute_storage_read_write, doc);
}

/// A changed voxel reaches `radius` voxels along the axes passed so far.
void record(PassContext& context) {
  const Extent3 grid = context.output_extent("distance");
  const auto radius = static_cast<int32_t>(context.params().integer("radius"));
  const bool kept = context.kept("distance") && context.kept("along_x") && context.kept("along_xy");
  const std::vector<VoxelBox> changed = boxes_to_update(context, grid, kept, radius);
  std::array<int32_t, 3> reach{0, 0, 0};
  for (int32_t axis = 0; axis < 3; ++axis) {
    reach[static_cast<size_t>(axis)] = radius;
    for (const VoxelBox& box : widened(changed, reach, grid))
      context.dispatch(box_dispatch("distance_transform.comp", box, {{"axis", axis}}));
  }
}

}  // namespace

PassType make_distance_transform() {
  PassType type;
  type.name = "distance_transform";
  type.doc =
      "Chessboard distance to the nearest occupied voxel, exact up to `radius` (the paper's partial distance "
      "transform, section 2.1). Separable: along each axis d' = min over k of max(|k|, d); 0 in an occupied voxel, "
      "radius + 1 where none lies within the radius. Outside the grid is empty. Rewritten only up to the radius around "
      "what moved. It says where the voxels are, so it cannot be spared; `march` dda does without its lengths.";
  Port distance = volume("distance", Direction::out, Access::compute_storage_write, "distance [voxels / 255]");
  type.ports = {voxels_input("voxels", "alpha of the albedo image is the occupancy"), distance,
                scratch_volume("along_x", "distance within the row [voxels / 255]"),
                scratch_volume("along_xy", "distance within the slice [voxels / 255]")};
  type.params = {
      integer_param("radius", 4, 1, 31, "voxels", "up to where distances are exact; the paper's author used 4"),
      update_param()};
  type.record = record;
  return type;
}

}  // namespace lightloom::passes
