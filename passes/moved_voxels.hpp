#pragma once

#include "framework/graph/pass_type.hpp"

namespace lightloom::passes {

[[nodiscard]] PassType make_moved_voxels();

}  // namespace lightloom::passes
