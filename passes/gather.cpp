#include "passes/gather.hpp"

#include "passes/port_rows.hpp"

namespace lightloom::passes {
namespace {

Port surface_output() {
  return bundle_output("surface", surface_parts(), ExtentRule::view, Access::color_attachment_write,
                       "the G-buffer; 0 throughout where nothing is seen");
}

Port depth_scratch() {
  return scratch_image("depth", {"", Format::d32_sfloat, "clip-space depth, 0 near to 1 far"}, ExtentRule::view,
                       Access::depth_attachment_write, "depth test");
}

Port motion_output() {
  Port port;
  port.name = "motion";
  port.direction = Direction::out;
  port.parts = {{"", Format::rg32_sfloat, ""}};
  port.extent = ExtentRule::view;
  port.access = Access::compute_storage_write;
  port.bypass = Bypass{"", {0, 0, 0, 0}};
  port.doc =
      "where the point was on the screen one frame ago minus where it is now, by the motion of camera and object "
      "[pixels, x right, y down]; the background as if infinitely far away; 0 in the first frame, behind the earlier "
      "camera, and for the background of an orthographic one";
  return port;
}

void draw_surface(PassContext& context) {
  context.clear("surface", {0, 0, 0, 0});
  const TriangleRange fixed = context.static_triangles();
  const uint32_t count = fixed.count + context.dynamic_triangles().count;
  if (count == 0) return;
  // One draw: dynamic triangles follow the static ones in the buffer.
  context.draw({.vertex_shader = "gather.vert",
                .fragment_shader = "gather.frag",
                .first_triangle = fixed.first,
                .triangle_count = count,
                .depth_port = "depth",
                .area = {},
                .values = {}});
}

void record(PassContext& context) {
  draw_surface(context);
  // Not in the draw: the G-buffer has as many attachments as every device allows.
  if (context.wanted("motion")) context.dispatch({"gather_motion.comp", context.output_extent("motion"), {}});
}

}  // namespace

PassType make_gather() {
  PassType type;
  type.name = "gather";
  type.doc =
      "Rasterised G-buffer: the first surface through each pixel with its material (paper, section 2.1), because "
      "voxels are too coarse for the first hit. Alpha-masked texels are cut out; the back of a single-sided material "
      "is not seen; a double-sided one is turned to the viewer.";
  type.ports = {surface_output(), motion_output(), depth_scratch()};
  type.reads = FrameState::camera | FrameState::static_geometry | FrameState::dynamic_geometry | FrameState::materials;
  type.record = record;
  return type;
}

}  // namespace lightloom::passes
