#include "passes/box_blur.hpp"

#include "passes/spatial_filter.hpp"

namespace lightloom::passes {

PassType make_box_blur() {
  return make_spatial_filter(
      "box_blur",
      "Mean over a row or column of pixels, with the rejection tests of `denoise_radial` (paper, section 2.4, passes "
      "three and four).",
      {{"axis", ParamType::choice, std::string("x"), {}, {}, {"x", "y"}, "", "direction on the screen"},
       {"radius",
        ParamType::integer,
        int64_t{2},
        0,
        64,
        {},
        "pixels",
        "half width; the kernel has 2 radius + 1 taps"}});
}

}  // namespace lightloom::passes
