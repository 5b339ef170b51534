#pragma once

#include "framework/graph/pass_type.hpp"

namespace lightloom::passes {

[[nodiscard]] PassType make_light_reservoirs();

}  // namespace lightloom::passes
