#pragma once

#include "framework/graph/pass_type.hpp"

namespace lightloom::passes {

/// List of the exposed faces of emissive voxels, by which `voxel_path_trace` samples their light.
[[nodiscard]] PassType make_emissive_faces();

}  // namespace lightloom::passes
