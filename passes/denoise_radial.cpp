#include "passes/denoise_radial.hpp"

#include "passes/port_rows.hpp"

namespace lightloom::passes {

PassType make_denoise_radial() {
  PassType type;
  type.name = "denoise_radial";
  type.doc =
      "Mean along the tangent or bitangent of each surface, marched outwards from the centre on the screen. The "
      "length is scaled by the roughness along that axis and grows with the distance from the viewer; a radial "
      "cut-off, the normals and the object id keep light from bleeding (paper, section 2.4, passes one and two).";
  Port radiance =
      image_output_like("radiance", Format::rgba32_sfloat, "radiance", "rgb: filtered radiance; a: as it came in");
  radiance.bypass = Bypass{"radiance", {}};
  type.ports = {image_input("radiance", Format::rgba32_sfloat, "what to filter"),
                same_size_as("radiance", surface_input("surface", "G-buffer of the same pixels")), radiance};
  type.params = {
      {"axis",
       ParamType::choice,
       std::string("tangent"),
       {},
       {},
       {"tangent", "bitangent"},
       "",
       "direction to march in"},
      {"taps", ParamType::integer, int64_t{20}, 0, 256, {}, "pixels", "most samples on each side of the centre"},
      {"floor_fraction",
       ParamType::real,
       0.0035,
       0,
       1,
       {},
       "scene diagonals",
       "half length near the viewer, at roughness 1"},
      {"distance_fraction",
       ParamType::real,
       1.0 / 30.0,
       0,
       1,
       {},
       "distances from the viewer",
       "half length far from the viewer, at roughness 1"},
      {"normal_threshold", ParamType::real, 0.9, -1, 1, {}, "", "smallest cosine between the normals"},
  };
  type.reads = FrameState::camera;
  type.record = [](PassContext& context) {
    context.dispatch({"denoise_radial.comp", context.output_extent("radiance"), {}});
  };
  return type;
}

}  // namespace lightloom::passes
