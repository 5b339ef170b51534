#include "passes/denoise_radial.hpp"

#include "passes/param_rows.hpp"
#include "passes/spatial_filter.hpp"

namespace lightloom::passes {

PassType make_denoise_radial() {
  return make_spatial_filter(
      "denoise_radial",
      "Mean along the tangent or bitangent of each surface, marched outwards from the centre on the screen. The length "
      "is scaled by the roughness along that axis and grows with the distance from the viewer; a radial cut-off, the "
      "normals and the object id keep light from bleeding (paper, section 2.4, passes one and two).",
      {choice_param("axis", "tangent", {"tangent", "bitangent"}, "direction to march in"),
       integer_param("taps", 20, 0, 256, "pixels", "most samples on each side of the centre")});
}

}  // namespace lightloom::passes
