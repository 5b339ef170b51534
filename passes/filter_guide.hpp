#pragma once

#include "framework/graph/pass_type.hpp"

namespace lightloom::passes {

/// What denoise_radial and box_blur ask of each neighbour, in one texel (shaders/lib/filter_guide.glsl).
[[nodiscard]] PassType make_filter_guide();

}  // namespace lightloom::passes
