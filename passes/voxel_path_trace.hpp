#pragma once

#include "framework/graph/pass_type.hpp"

namespace lightloom::passes {

[[nodiscard]] PassType make_voxel_path_trace();

}  // namespace lightloom::passes
