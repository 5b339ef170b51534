#pragma once

#include <vector>

#include "framework/gpu/descriptors.hpp"
#include "framework/graph/pass_context.hpp"

namespace lightloom::run {

/// What scene and frame offer to shaders.
struct SceneBindings {
  gpu::ResourceMap resources;       ///< by the names of shaders/lib/scene.glsl and textures.glsl
  std::vector<ShaderValue> values;  ///< `has_<feature>`, and which textures there are (shaders/lib/features.glsl)
  TriangleRange static_triangles;
  TriangleRange dynamic_triangles;
};

}  // namespace lightloom::run
