#pragma once

#include "framework/graph/pass_type.hpp"

namespace lightloom::passes {

/// Chessboard distance to the nearest occupied voxel, capped at a radius.
[[nodiscard]] PassType make_distance_transform();

}  // namespace lightloom::passes
