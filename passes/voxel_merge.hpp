#pragma once

#include "framework/graph/pass_type.hpp"

namespace lightloom::passes {

/// Static and dynamic voxels to one grid.
[[nodiscard]] PassType make_voxel_merge();

}  // namespace lightloom::passes
