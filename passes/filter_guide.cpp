#include "passes/filter_guide.hpp"

#include "passes/port_rows.hpp"

namespace lightloom::passes {

PassType make_filter_guide() {
  PassType type;
  type.name = "filter_guide";
  type.doc =
      "Object, normal, position, variance and relative error of each pixel in one texel of 128 bits, for the spatial "
      "filters, which look at up to forty neighbours a pixel: one load each instead of four. Positions are kept to "
      "2^-15 "
      "of the distance from the viewer, normals to 0.001, variances to 1/256, errors to 1/40. The error is that of the "
      "radiance given here, once for all the filters; without a guide each takes that of its own input.";
  type.ports = {
      surface_input("surface", "G-buffer"),
      optional(same_size_as("surface", image_input("radiance", Format::rgba32_sfloat,
                                                   "what will be filtered; unconnected: nothing is known of its error, "
                                                   "and filters have their full length"))),
      optional(same_size_as("surface", image_input("variance", Format::r32_sfloat,
                                                   "estimated variance of its luminance; unconnected: unknown"))),
      image_output_like("guide", Format::rgba32_uint, "surface", "packed by shaders/lib/filter_guide.glsl"),
  };
  type.reads = FrameState::camera;
  type.record = one_dispatch("filter_guide.comp", "guide");
  return type;
}

}  // namespace lightloom::passes
