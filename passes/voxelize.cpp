#include "passes/voxelize.hpp"

#include <algorithm>

#include "passes/port_rows.hpp"

namespace lightloom::passes {
namespace {

// 65535 groups of 64, the least that every device offers.
constexpr uint32_t kTrianglesPerDispatch = 65535 * 64;
constexpr uint32_t kVoxelsPerResolve = 16;  // along z, by one invocation; as in shaders/voxelize_resolve.comp

Port voxels_output() {
  Port port = bundle_output("voxels", voxel_parts(), ExtentRule::grid, Access::compute_storage_write,
                            "the grid; empty voxels are 0 throughout");
  port.dimension = Dimension::d3;
  port.bypass = Bypass{};
  return port;
}

Port owner_scratch() {
  Port port = scratch_image("owner", {"", Format::r32_uint, "index of the owning triangle + 1; 0: empty"},
                            ExtentRule::grid, Access::compute_storage_read_write, "who owns each voxel");
  port.dimension = Dimension::d3;
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

void record(PassContext& context) {
  const TriangleRange range = chosen_triangles(context);
  context.clear("owner", {0, 0, 0, 0});
  context.clear("voxels", {0, 0, 0, 0});
  for (uint32_t done = 0; done < range.count; done += kTrianglesPerDispatch) {
    const uint32_t count = std::min(range.count - done, kTrianglesPerDispatch);
    context.dispatch({"voxelize_claim.comp",
                      {count, 1, slice_count(count)},
                      {{"first_triangle", range.first + done}, {"triangle_count", count}}});
  }
  if (range.count == 0) return;
  const Extent3 grid = context.output_extent("voxels");
  context.dispatch({"voxelize_resolve.comp", {grid.width, grid.height, (grid.depth - 1) / kVoxelsPerResolve + 1}, {}});
}

}  // namespace

PassType make_voxelize() {
  PassType type;
  type.name = "voxelize";
  type.doc =
      "Voxelizes triangles into the three RGBA8 images of the paper (section 2.1). A voxel is occupied if a triangle "
      "touches its closed box (supercover; triangle-box test of Schwarz and Seidel 2010). The triangle that is last "
      "in draw order owns the voxel, by one atomic maximum, and all attributes come from its point nearest to the "
      "voxel's centre, so a voxel is consistent and every run gives the same bits. Normals are those of the front "
      "face.";
  type.ports = {voxels_output(), owner_scratch()};
  type.params = {
      {"geometry", ParamType::choice, std::string("all"), {}, {}, {"static", "dynamic", "all"}, "", "which triangles"},
      {"resolution",
       ParamType::integer,
       int64_t{128},
       8,
       512,
       {},
       "voxels",
       "voxels along the longest side of the scene, one voxel of padding at each end included"},
  };
  type.reads = FrameState::static_geometry | FrameState::dynamic_geometry | FrameState::materials;
  type.record = record;
  return type;
}

}  // namespace lightloom::passes
