#include "passes/voxel_merge.hpp"

#include "passes/port_rows.hpp"

namespace lightloom::passes {
PassType make_voxel_merge() {
  PassType type;
  type.name = "voxel_merge";
  type.doc =
      "Combines static voxels with re-voxelized dynamic ones (paper, section 2.1): where both are occupied, "
      "`priority` decides. Plain stores, no compare-and-swap.";
  Port voxels = image_output_like("voxels", Format::rgba8_unorm, "static", "both");
  voxels.bundle = "voxels";
  voxels.parts = voxel_parts();
  voxels.dimension = Dimension::d3;
  voxels.bypass = Bypass{"static", {}};
  type.ports = {voxels_input("static", "voxels of what never moves"),
                same_size_as("static", voxels_input("dynamic", "voxels of what moves")), voxels};
  type.params = {{"priority",
                  ParamType::choice,
                  std::string("dynamic"),
                  {},
                  {},
                  {"dynamic", "static"},
                  "",
                  "which side wins where both are occupied"}};
  type.record = [](PassContext& context) {
    context.dispatch({"voxel_merge.comp", context.output_extent("voxels"), {}});
  };
  return type;
}

}  // namespace lightloom::passes
