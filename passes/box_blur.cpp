#include "passes/box_blur.hpp"

#include "passes/param_rows.hpp"
#include "passes/spatial_filter.hpp"

namespace lightloom::passes {

PassType make_box_blur() {
  return make_spatial_filter(
      "box_blur",
      "Mean over a row or column of pixels, with the rejection tests of `denoise_radial` (paper, section 2.4, passes "
      "three and four). With `variance` connected the half width shrinks like the length of `denoise_radial`.",
      {choice_param("axis", "x", {"x", "y"}, "direction on the screen"),
       integer_param("radius", 2, 0, 64, "pixels", "half width; the kernel has 2 radius + 1 taps"),
       choice_param("cutoff", "radial", {"radial", "elliptic"},
                    "`radial`: neighbours within the reach at the larger roughness; `elliptic`: within the ellipse "
                    "whose half axes are the reach at the roughness along the tangent and across it, so that nothing "
                    "is mixed across the grain of brushed metal that the radial passes have kept apart")});
}

}  // namespace lightloom::passes
