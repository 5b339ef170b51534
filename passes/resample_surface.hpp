#pragma once

#include "framework/graph/pass_type.hpp"

namespace lightloom::passes {

/// The G-buffer at trace size, nearest texel.
[[nodiscard]] PassType make_resample_surface();

}  // namespace lightloom::passes
