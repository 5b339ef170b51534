#pragma once

#include "framework/graph/pass_type.hpp"

namespace lightloom::passes {

/// Triangles to the three voxel images: supercover, one owner triangle a voxel.
[[nodiscard]] PassType make_voxelize();

}  // namespace lightloom::passes
