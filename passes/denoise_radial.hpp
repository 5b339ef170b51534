#pragma once

#include "framework/graph/pass_type.hpp"

namespace lightloom::passes {

[[nodiscard]] PassType make_denoise_radial();

}  // namespace lightloom::passes
