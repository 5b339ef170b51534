#include "passes/upsample.hpp"

#include "passes/port_rows.hpp"

namespace lightloom::passes {

PassType make_upsample() {
  PassType type;
  type.name = "upsample";
  type.doc =
      "Brings traced radiance to the size of the view. For each pixel the traced pixels around it are searched from "
      "the inside out for the one whose position and normal are most alike (paper, section 2.5).";
  Port radiance = image_output_like("radiance", Format::rgba32_sfloat, "surface",
                                    "rgb: radiance of the best candidate; a: its alpha; 0 for the background");
  radiance.bypass = Bypass{"radiance", {}};  // fits where the trace has the size of the view
  type.ports = {image_input("radiance", Format::rgba32_sfloat, "traced radiance"),
                same_size_as("radiance", surface_input("trace_surface", "G-buffer of the traced pixels")),
                surface_input("surface", "G-buffer at the size of the view"), radiance};
  type.params = {
      {"rings", ParamType::integer, int64_t{3}, 0, 16, {}, "pixels", "how far the search goes, in traced pixels"},
      {"threshold", ParamType::real, 0.5, 0, 1, {}, "", "similarity at which a candidate is good enough to stop"},
  };
  type.reads = FrameState::camera;
  type.record = [](PassContext& context) {
    context.dispatch({"upsample.comp", context.output_extent("radiance"), {}});
  };
  return type;
}

}  // namespace lightloom::passes
