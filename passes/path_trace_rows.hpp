#pragma once

#include <string>
#include <vector>

#include "framework/graph/param.hpp"
#include "framework/graph/port.hpp"
#include "passes/param_rows.hpp"

// What passes that trace paths from the G-buffer on the device have in common: outputs and params of the same names, so
// that one type can take another's place.
namespace lightloom::passes {

/// `inputs`, of which one is called `surface`, and the outputs `radiance`, `diffuse` and `specular` (written by
/// shaders/lib/traced_light.glsl).
[[nodiscard]] std::vector<Port> with_light_outputs(std::vector<Port> inputs);

/// `own` among the params that all such passes take.
[[nodiscard]] std::vector<Param> with_path_params(const std::vector<Param>& own);

}  // namespace lightloom::passes
