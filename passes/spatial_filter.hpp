#pragma once

#include <string>
#include <vector>

#include "framework/graph/pass_type.hpp"

namespace lightloom::passes {

/// What the spatial filters of the denoiser share: `radiance` in and out with a bypass, the G-buffer as a guide, the
/// params of the rejection tests in shaders/lib/neighbour.glsl, and one dispatch of the shader "<name>.comp".
PassType make_spatial_filter(const std::string& name, std::string doc, std::vector<Param> own_params);

}  // namespace lightloom::passes
