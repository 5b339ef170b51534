#pragma once

#include "framework/graph/pass_type.hpp"

namespace lightloom::passes {

/// How many grids of boxes lie beside each other along each axis (shaders/lib/empty_box.glsl).
inline constexpr Extent3 kBoxBlocks{1, 2, 2};

/// See the doc string of the pass type.
[[nodiscard]] PassType make_empty_boxes();

}  // namespace lightloom::passes
