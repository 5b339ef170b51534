#pragma once

#include <string>
#include <vector>

#include "framework/graph/pass_type.hpp"

namespace lightloom::passes {

/// What the spatial filters of the denoiser share: `radiance` in and out with a bypass, the G-buffer and, where it is
/// connected, the variance as guides, the params of shaders/lib/neighbour.glsl (reach and its scale, rejection tests,
/// variance guide), and one dispatch of the shader "<name>.comp".
PassType make_spatial_filter(const std::string& name, std::string doc, std::vector<Param> own_params);

}  // namespace lightloom::passes
