#pragma once

#include <vector>

#include "framework/gpu/descriptors.hpp"
#include "framework/graph/pass_context.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::run {

/// What scene and frame offer to shaders.
struct SceneBindings {
  gpu::ResourceMap resources;       ///< by the names of shaders/lib/scene.glsl and textures.glsl
  std::vector<ShaderValue> values;  ///< `has_<feature>`, and which textures there are (shaders/lib/features.glsl)
  TriangleRange static_triangles;
  TriangleRange dynamic_triangles;
  std::vector<TriangleRange> opaque_triangles;  ///< PassContext::triangles
  std::vector<TriangleRange> masked_triangles;
  scene::Bounds bounds;              ///< of the scene, over all frames [m]
  std::vector<scene::Bounds> moved;  ///< MovingObjects::moved of this frame [m]
};

}  // namespace lightloom::run
