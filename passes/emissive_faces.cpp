#include "passes/emissive_faces.hpp"

#include <algorithm>
#include <array>

#include "passes/port_rows.hpp"
#include "passes/voxel_boxes.hpp"

namespace lightloom::passes {
namespace {

// kFaceRow of shaders/lib/emissive_faces.glsl, the largest grid, kEmissionLimit of shaders/lib/scene.glsl, and the
// lines of shaders/lib/emissive_columns.glsl.
constexpr Extent3 kListExtent{1024, 1024, 1};
constexpr Extent3 kColumnsExtent{512, 512, 1};
constexpr Extent3 kPowerExtent{256, 1, 1};
constexpr Extent3 kRowPowerExtent{256, 512, 1};
constexpr Extent3 kRowsExtent{512, 6, 1};
constexpr uint32_t kRowInvocations = 64;  // as in shaders/emissive_faces_rows.comp

Port fixed_image(std::string name, Direction direction, Format format, Extent3 extent, Access access, std::string doc) {
  Port port;
  port.name = std::move(name);
  port.direction = direction;
  port.parts = {{"", format, ""}};
  port.extent = ExtentRule::fixed;
  port.fixed_extent = extent;
  port.access = access;
  port.doc = std::move(doc);
  port.persistent = true;
  return port;
}

Port scratch(std::string name, Format format, Extent3 extent, std::string doc) {
  return fixed_image(std::move(name), Direction::scratch, format, extent, Access::compute_storage_read_write,
                     std::move(doc));
}

std::vector<Port> ports() {
  Port faces =
      fixed_image("faces", Direction::out, Format::rg32_uint, kListExtent, Access::compute_storage_write,
                  "the list, in rows. Texel 0: number of faces; sum of their weights. Texel i: y << 21 | x << "
                  "12 | z << 3 | face (0 to 5: -x, +x, -y, +y, -z, +z); sum of the weights up to and including "
                  "this face. What follows the last face is 0");
  faces.bypass = Bypass{};
  Port power = fixed_image("power", Direction::out, Format::r32_uint, kPowerExtent, Access::compute_storage_read_write,
                           "by emission index: 512 times the power of all its exposed faces over that of one which "
                           "emits into its whole hemisphere, (1 + a . n) / 2 for one-sided emitters");
  power.bypass = Bypass{};
  return {voxels_input("voxels", "the grid"),
          faces,
          power,
          scratch("columns", Format::rg32_uint, kColumnsExtent, "by x and y: number and weight of the faces along z"),
          scratch("spans", Format::r32_uint, kColumnsExtent,
                  "by x and y: first of the emissive voxels along z, and the one past the last << 16; 0: none"),
          scratch("rows", Format::r32_uint, kRowsExtent,
                  "by y, in lines: rows to count again, number and weight of the faces, those of the rows before, "
                  "and what the whole list was"),
          scratch("row_power", Format::r32_uint, kRowPowerExtent, "`power` by emission index and y")};
}

bool all_kept(const PassContext& context) {
  const std::array<const char*, 6> kept = {"faces", "power", "columns", "spans", "rows", "row_power"};
  return std::all_of(kept.begin(), kept.end(), [&](const char* port) { return context.kept(port); });
}

/// A voxel that changes exposes or hides the faces of its neighbours.
void record(PassContext& context) {
  const Extent3 grid = context.input_extent("voxels");
  const std::vector<VoxelBox> changed = boxes_to_update(context, grid, all_kept(context), 1);
  if (changed.empty()) return;
  if (changed.front() == whole_grid(grid))
    for (const char* port : {"faces", "power", "columns", "spans", "rows", "row_power"})
      context.clear(port, {0, 0, 0, 0});
  for (const VoxelBox& box : widened(changed, {1, 1, 1}, grid))
    context.dispatch(box_dispatch("emissive_faces.comp", box, {}, grid.depth));
  const Extent3 groups{kRowInvocations, grid.height, 1};
  context.dispatch({"emissive_faces_rows.comp", groups, {{"writing", false}}});
  context.dispatch({"emissive_faces_scan.comp", {1, 1, 1}, {{"finishing", false}}});
  context.dispatch({"emissive_faces_rows.comp", groups, {{"writing", true}}});
  context.dispatch({"emissive_faces_scan.comp", {1, 1, 1}, {{"finishing", true}}});
}

}  // namespace

PassType make_emissive_faces() {
  PassType type;
  type.name = "emissive_faces";
  type.doc =
      "Lists the faces of emissive voxels that empty space or the border of the grid adjoins: the emitters that rays "
      "through the grid meet, so that next event estimation can sample the very same. A face weighs as much as the "
      "luminance of its power, relative to the brightest emission, in 4095 steps: radiance for two-sided emitters, "
      "radiance times (1 + a . n) / 2 for one-sided ones, a being the face's normal and n the voxel's. Faces that do "
      "not emit are left out, as are those beyond the first 1048575. In the order of y, x, z, face, whatever the "
      "device does first: columns are counted, rows of them summed up, one work group scans the sums, rows are "
      "written. Only "
      "columns around what moved are counted again, and the list is written from the first row on in which something "
      "emits or did there.";
  type.ports = ports();
  type.params = {update_param()};
  type.reads = FrameState::materials;
  type.record = record;
  return type;
}

}  // namespace lightloom::passes
