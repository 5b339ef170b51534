#pragma once

#include "framework/graph/pass_type.hpp"

namespace lightloom::passes {

[[nodiscard]] PassType make_voxel_path_trace();

/// What passes that trace light through voxels have in common: the voxels, what rays march by, and emissive faces.
[[nodiscard]] std::vector<Port> light_inputs();
/// How their rays march, how they find emissive voxels, and how their paths end by chance.
[[nodiscard]] std::vector<Param> voxel_path_params();
/// Throws Error for a param that needs an input which is not connected.
void require_light_inputs(const PassContext& context);

}  // namespace lightloom::passes
