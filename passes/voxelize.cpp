#include "passes/voxelize.hpp"

#include <algorithm>

#include "passes/param_rows.hpp"
#include "passes/port_rows.hpp"
#include "passes/voxel_boxes.hpp"

namespace lightloom::passes {
namespace {

// 65535 groups of 64, the least that every device offers.
constexpr uint32_t kTrianglesPerDispatch = 65535 * 64;
constexpr uint32_t kVoxelsPerResolve = 16;  // along z, by one invocation; as in shaders/voxelize_resolve.comp

Port voxels_output() {
  Port port = bundle_output("voxels", voxel_parts(), ExtentRule::grid, Access::compute_storage_write,
                            "the grid; empty voxels are 0 throughout");
  port.dimension = Dimension::d3;
  port.persistent = true;
  port.bypass = Bypass{};
  return port;
}

Port owner_scratch() {
  Port port = scratch_image(
      "owner",
      {"", Format::r32_uint,
       "index of the owning triangle + 1, with `priority` emissive the highest bit set where it emits; 0: empty"},
      ExtentRule::grid, Access::compute_storage_read_write, "who owns each voxel");
  port.dimension = Dimension::d3;
  port.persistent = true;
  return port;
}

TriangleRange chosen_triangles(const PassContext& context) {
  const TriangleRange fixed = context.static_triangles();
  const TriangleRange moving = context.dynamic_triangles();
  const std::string& geometry = context.params().choice("geometry");
  if (geometry == "static") return fixed;
  if (geometry == "dynamic") return moving;
  return {fixed.first, fixed.count + moving.count};
}

/// Invocations along z that share the columns of each large triangle: many where triangles are few, so that a dozen
/// walls still fill the device.
uint32_t slice_count(uint32_t triangles) {
  constexpr uint32_t kWantedInvocations = 65536;
  constexpr uint32_t kMostSlices = 64;
  return std::clamp(kWantedInvocations / triangles, 1u, kMostSlices);
}

/// What may look different from a frame ago; static triangles never do.
std::vector<VoxelBox> changed_boxes(const PassContext& context, const Extent3& grid) {
  const bool kept = context.kept("voxels") && context.kept("owner");
  std::vector<VoxelBox> boxes = boxes_to_update(context, grid, kept);
  const bool all = boxes.size() == 1 && boxes.front() == whole_grid(grid);
  const ParamSet& params = context.params();
  if (kept && !all && params.choice("geometry") == "static") return {};
  return boxes;
}

void clear_boxes(PassContext& context, const std::vector<VoxelBox>& boxes, const Extent3& grid) {
  if (boxes.front() == whole_grid(grid)) {
    context.clear("owner", {0, 0, 0, 0});
    context.clear("voxels", {0, 0, 0, 0});
    return;
  }
  for (const VoxelBox& box : boxes) context.dispatch(box_dispatch("voxelize_clear.comp", box));
}

void claim_supercover(PassContext& context, const TriangleRange& range) {
  for (uint32_t done = 0; done < range.count; done += kTrianglesPerDispatch) {
    const uint32_t count = std::min(range.count - done, kTrianglesPerDispatch);
    context.dispatch({"voxelize_claim.comp",
                      {count, 1, slice_count(count)},
                      {{"first_triangle", range.first + done}, {"triangle_count", count}}});
  }
}

void claim_raster(PassContext& context, const TriangleRange& range, const Extent3& grid) {
  const uint32_t columns = std::max({grid.width, grid.height, grid.depth});
  context.draw(
      {"voxelize_raster.vert",
       "voxelize_raster.frag",
       {range},
       "",
       {columns, columns, 1},
       {{"grid_width", grid.width}, {"grid_height", grid.height}, {"grid_depth", grid.depth}, {"columns", columns}}});
}

void record(PassContext& context) {
  const Extent3 grid = context.output_extent("voxels");
  const std::vector<VoxelBox> boxes = changed_boxes(context, grid);
  if (boxes.empty()) return;
  clear_boxes(context, boxes, grid);
  const TriangleRange range = chosen_triangles(context);
  if (range.count == 0) return;
  // Claims outside the boxes are those that stand there already: an atomic maximum may be taken twice.
  if (context.params().choice("coverage") == "raster")
    claim_raster(context, range, grid);
  else
    claim_supercover(context, range);
  for (const VoxelBox& box : boxes) context.dispatch(box_dispatch("voxelize_resolve.comp", box, {}, kVoxelsPerResolve));
}

FrameState read_with(const ParamSet& params) {
  const std::string& geometry = params.choice("geometry");
  if (geometry == "static") return FrameState::static_geometry | FrameState::materials;
  if (geometry == "dynamic") return FrameState::dynamic_geometry | FrameState::materials;
  return FrameState::static_geometry | FrameState::dynamic_geometry | FrameState::materials;
}

}  // namespace

PassType make_voxelize() {
  PassType type;
  type.name = "voxelize";
  type.doc =
      "Voxelizes triangles into the three RGBA8 images of the paper (section 2.1). A triangle takes the voxels that "
      "`coverage` says: with `supercover` all whose closed box it touches (triangle-box test of Schwarz and Seidel "
      "2010); with `raster`, the paper's way, the hardware draws it along its dominant axis and it takes one voxel for "
      "each column whose centre line meets it, so thin and slanted things have holes. The triangle that `priority` "
      "says owns a voxel, by one atomic maximum, and all attributes come from its point nearest to the voxel's centre, "
      "so a voxel is consistent and every run gives the same bits. Normals are those of the front face. A triangle "
      "without area takes nothing.";
  type.ports = {voxels_output(), owner_scratch()};
  type.params = {
      choice_param("geometry", "all", {"static", "dynamic", "all"}, "which triangles"),
      choice_param("coverage", "supercover", {"raster", "supercover"}, "which voxels a triangle takes"),
      integer_param("resolution", 128, 8, 512, "voxels",
                    "voxels along the longest side of the scene, one voxel of padding at each end included"),
      choice_param(
          "priority", "draw_order", {"draw_order", "emissive"},
          "which of its triangles owns a voxel: the last in draw order (the paper's), or the last of those whose "
          "material emits where there is one, so that a lamp less than a voxel below a ceiling is not lost"),
      update_param(),
  };
  type.reads = FrameState::static_geometry | FrameState::dynamic_geometry | FrameState::materials;
  type.reads_with = read_with;
  type.record = record;
  return type;
}

}  // namespace lightloom::passes
