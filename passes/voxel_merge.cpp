#include "passes/voxel_merge.hpp"

#include "passes/param_rows.hpp"
#include "passes/port_rows.hpp"
#include "passes/voxel_boxes.hpp"

namespace lightloom::passes {
PassType make_voxel_merge() {
  PassType type;
  type.name = "voxel_merge";
  type.doc =
      "Combines static voxels with re-voxelized dynamic ones (paper, section 2.1): where both are occupied, `priority` "
      "decides. Plain stores, no compare-and-swap; only where something was or is moving.";
  Port voxels = image_output_like("voxels", Format::rgba8_unorm, "static", "both");
  voxels.bundle = "voxels";
  voxels.parts = voxel_parts();
  voxels.dimension = Dimension::d3;
  voxels.persistent = true;
  voxels.bypass = Bypass{"static", {}};
  type.ports = {voxels_input("static", "voxels of what never moves"),
                same_size_as("static", voxels_input("dynamic", "voxels of what moves")), voxels};
  type.params = {choice_param("priority", "dynamic", {"dynamic", "static"}, "which side wins where both are occupied"),
                 update_param()};
  type.record = [](PassContext& context) {
    for (const VoxelBox& box : boxes_to_update(context, context.output_extent("voxels"), context.kept("voxels")))
      context.dispatch(box_dispatch("voxel_merge.comp", box));
  };
  return type;
}

}  // namespace lightloom::passes
