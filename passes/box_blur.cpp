#include "passes/box_blur.hpp"

#include "passes/port_rows.hpp"

namespace lightloom::passes {

PassType make_box_blur() {
  PassType type;
  type.name = "box_blur";
  type.doc =
      "Mean over a row or column of pixels, with the rejection tests of `denoise_radial` (paper, section 2.4, passes "
      "three and four).";
  Port radiance =
      image_output_like("radiance", Format::rgba32_sfloat, "radiance", "rgb: filtered radiance; a: as it came in");
  radiance.bypass = Bypass{"radiance", {}};
  type.ports = {image_input("radiance", Format::rgba32_sfloat, "what to filter"),
                same_size_as("radiance", surface_input("surface", "G-buffer of the same pixels")), radiance};
  type.params = {
      {"axis", ParamType::choice, std::string("x"), {}, {}, {"x", "y"}, "", "direction on the screen"},
      {"radius", ParamType::integer, int64_t{2}, 0, 64, {}, "pixels", "half width; the kernel has 2 radius + 1 taps"},
      {"floor_fraction",
       ParamType::real,
       0.0035,
       0,
       1,
       {},
       "scene diagonals",
       "radial cut-off near the viewer, at roughness 1"},
      {"distance_fraction",
       ParamType::real,
       1.0 / 30.0,
       0,
       1,
       {},
       "distances from the viewer",
       "radial cut-off far from the viewer, at roughness 1"},
      {"normal_threshold", ParamType::real, 0.9, -1, 1, {}, "", "smallest cosine between the normals"},
  };
  type.reads = FrameState::camera;
  type.record = [](PassContext& context) {
    context.dispatch({"box_blur.comp", context.output_extent("radiance"), {}});
  };
  return type;
}

}  // namespace lightloom::passes
