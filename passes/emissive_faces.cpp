#include "passes/emissive_faces.hpp"

#include "passes/port_rows.hpp"

namespace lightloom::passes {
namespace {

// kFaceRow of shaders/lib/emissive_faces.glsl, the largest grid, and kEmissionLimit of shaders/lib/scene.glsl.
constexpr Extent3 kListExtent{1024, 1024, 1};
constexpr Extent3 kColumnsExtent{512, 512, 1};
constexpr Extent3 kPowerExtent{256, 1, 1};

Port fixed_image(std::string name, Direction direction, Format format, Extent3 extent, Access access, std::string doc) {
  Port port;
  port.name = std::move(name);
  port.direction = direction;
  port.parts = {{"", format, ""}};
  port.extent = ExtentRule::fixed;
  port.fixed_extent = extent;
  port.access = access;
  port.doc = std::move(doc);
  return port;
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
  return {
      voxels_input("voxels", "the grid"), faces, power,
      fixed_image("columns", Direction::scratch, Format::rg32_uint, kColumnsExtent, Access::compute_storage_read_write,
                  "by x and y: number and weight of the faces in the voxels along z, then of those before them")};
}

void record(PassContext& context) {
  const Extent3 grid = context.input_extent("voxels");
  const Extent3 columns{grid.width, grid.height, 1};
  context.clear("power", {0, 0, 0, 0});
  // What the list does not fill must not be what was in the memory before.
  context.clear("faces", {0, 0, 0, 0});
  context.clear("columns", {0, 0, 0, 0});
  context.dispatch({"emissive_faces.comp", columns, {{"writing", false}}});
  context.dispatch({"emissive_faces_scan.comp", {1, 1, 1}, {}});
  context.dispatch({"emissive_faces.comp", columns, {{"writing", true}}});
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
      "device "
      "does first: columns are counted, one work group scans the counts, columns are written.";
  type.ports = ports();
  type.reads = FrameState::materials;
  type.record = record;
  return type;
}

}  // namespace lightloom::passes
