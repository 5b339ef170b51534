#include "passes/gather.hpp"

#include "passes/bundles.hpp"

namespace lightloom::passes {
namespace {

Port surface_output() {
  Port port;
  port.name = "surface";
  port.direction = Direction::out;
  port.bundle = "surface";
  port.parts = surface_parts();
  port.extent = ExtentRule::view;
  port.access = Access::color_attachment_write;
  port.doc = "the G-buffer; 0 throughout where nothing is seen";
  return port;
}

Port depth_scratch() {
  Port port;
  port.name = "depth";
  port.direction = Direction::scratch;
  port.parts = {{"", Format::d32_sfloat, "clip-space depth, 0 near to 1 far"}};
  port.extent = ExtentRule::view;
  port.access = Access::depth_attachment_write;
  port.doc = "depth test";
  return port;
}

void record(PassContext& context) {
  context.clear("surface", {0, 0, 0, 0});
  const TriangleRange fixed = context.static_triangles();
  const uint32_t count = fixed.count + context.dynamic_triangles().count;
  if (count == 0) return;
  // One draw: dynamic triangles follow the static ones in the buffer.
  context.draw({.vertex_shader = "gather.vert",
                .fragment_shader = "gather.frag",
                .first_triangle = fixed.first,
                .triangle_count = count,
                .color_port = "surface",
                .depth_port = "depth",
                .values = {}});
}

}  // namespace

PassType make_gather() {
  PassType type;
  type.name = "gather";
  type.doc =
      "Rasterised G-buffer: the first surface through each pixel with its material (paper, section 2.1), because "
      "voxels are too coarse for the first hit. Alpha-masked texels are cut out; the back of a single-sided material "
      "is not seen; a double-sided one is turned to the viewer.";
  type.ports = {surface_output(), depth_scratch()};
  type.reads = FrameState::camera | FrameState::static_geometry | FrameState::dynamic_geometry | FrameState::materials;
  type.record = record;
  return type;
}

}  // namespace lightloom::passes
