#pragma once

#include "framework/graph/pass_type.hpp"

namespace lightloom::passes {

/// Pictures of the voxel grid for people: through the camera, or a slice.
PassType make_view_voxels();

}  // namespace lightloom::passes
