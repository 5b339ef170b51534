#include "passes/gather.hpp"

#include "passes/port_rows.hpp"

namespace lightloom::passes {
namespace {

Port surface_output() {
  return bundle_output("surface", surface_parts(), ExtentRule::view, Access::compute_storage_write,
                       "the G-buffer; 0 throughout where nothing is seen");
}

Port depth_scratch() {
  return scratch_image("depth", {"", Format::d32_sfloat, "clip-space depth, 0 near to 1 far"}, ExtentRule::view,
                       Access::depth_attachment_write, "depth test");
}

Port visibility_scratch() {
  return scratch_image("visibility",
                       {"", Format::r32_uint, "index of the triangle that is seen + 1; 0: the background"},
                       ExtentRule::view, Access::color_attachment_write, "which triangle each pixel shows");
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

// Which triangle each pixel shows: what is hidden costs a depth test, and the surface is computed once a pixel.
void draw_visibility(PassContext& context) {
  context.clear("visibility", {0, 0, 0, 0});
  Draw draw{.vertex_shader = "gather.vert",
            .fragment_shader = "gather.frag",
            .triangles = context.triangles(TriangleKind::opaque),
            .depth_port = "depth",
            .area = {},
            .values = {},
            .keep_depth = false};
  if (!draw.triangles.empty()) context.draw(draw);
  // A shader that discards is run before the depth test, so what has no holes does not come this way.
  draw.keep_depth = !draw.triangles.empty();
  draw.triangles = context.triangles(TriangleKind::masked);
  draw.vertex_shader = "gather_masked.vert";
  draw.fragment_shader = "gather_masked.frag";
  if (!draw.triangles.empty()) context.draw(draw);
}

void record(PassContext& context) {
  draw_visibility(context);
  context.dispatch({"gather_surface.comp", context.output_extent("surface"), {}});
  if (context.wanted("motion")) context.dispatch({"gather_motion.comp", context.output_extent("motion"), {}});
}

}  // namespace

PassType make_gather() {
  PassType type;
  type.name = "gather";
  type.doc =
      "Rasterised G-buffer: the first surface through each pixel with its material (paper, section 2.1), because "
      "voxels are too coarse for the first hit. What is drawn is which triangle each pixel shows; the surface is then "
      "computed once a pixel, where the ray through its centre meets that triangle. Alpha-masked texels are cut out; "
      "the back of a single-sided material "
      "is not seen; a double-sided one is turned to the viewer. Of triangles at equal depth an alpha-masked one is "
      "seen "
      "before one without a mask, and else the later one in the scene.";
  type.ports = {surface_output(), motion_output(), visibility_scratch(), depth_scratch()};
  type.reads = FrameState::camera | FrameState::static_geometry | FrameState::dynamic_geometry | FrameState::materials;
  type.record = record;
  return type;
}

}  // namespace lightloom::passes
