#include "passes/upsample.hpp"

#include "passes/param_rows.hpp"
#include "passes/port_rows.hpp"

namespace lightloom::passes {

PassType make_upsample() {
  PassType type;
  type.name = "upsample";
  type.doc =
      "Brings traced radiance to the size of the view. `nearest`, after the paper (section 2.5): for each pixel the "
      "traced pixels around it are searched from the inside out for the one whose position and normal are most alike. "
      "`bilateral`: the four traced pixels around it are blended, weighted by how near they are on the screen and how "
      "alike in position and normal; where none of them will do, the search decides. Only pixels of the same object "
      "are taken, as long as the search meets any.";
  Port radiance = image_output_like("radiance", Format::rgba32_sfloat, "surface",
                                    "rgb: radiance; a: alpha of the traced pixels; 0 for the background");
  radiance.bypass = Bypass{"radiance", {}};  // fits where the trace has the size of the view
  Port specular = image_output_like("specular", Format::rgba32_sfloat, "surface",
                                    "the same of `specular`; 0 in scenes without specular reflection");
  specular.bypass = Bypass{"specular", {}};
  Port specular_input = same_size_as("radiance", image_input("specular", Format::rgba32_sfloat,
                                                             "a second image, brought along by the same weights; for "
                                                             "the specular part where `radiance` is the diffuse part"));
  specular_input.optional = true;
  type.ports = {image_input("radiance", Format::rgba32_sfloat, "traced radiance"),
                specular_input,
                same_size_as("radiance", surface_input("trace_surface", "G-buffer of the traced pixels")),
                surface_input("surface", "G-buffer at the size of the view"),
                radiance,
                specular};
  type.params = {
      choice_param("filter", "bilateral", {"bilateral", "nearest"}, "how the traced pixels become one"),
      integer_param("rings", 3, 0, 16, "pixels", "how far the search goes, in traced pixels"),
      real_param("threshold", 0.5, 0, 1, "", "similarity at which a candidate is good enough to end the search"),
  };
  type.reads = FrameState::camera;
  type.record = [](PassContext& context) {
    context.dispatch({"upsample.comp",
                      context.output_extent("radiance"),
                      {{"filter_kind", context.params().choice_index("filter")}}});
  };
  return type;
}

}  // namespace lightloom::passes
