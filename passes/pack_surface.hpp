#pragma once

#include "framework/graph/pass_type.hpp"

namespace lightloom::passes {

/// What temporal_accumulate_packed asks of earlier frames, in one texel (shaders/lib/packed_surface.glsl).
[[nodiscard]] PassType make_pack_surface();

}  // namespace lightloom::passes
