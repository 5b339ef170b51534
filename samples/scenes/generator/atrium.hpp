#pragma once

#include "samples/scenes/generator/gltf_builder.hpp"

namespace lightloom::samples {

/// The whole scene: materials, meshes, nodes, camera and animation.
[[nodiscard]] GltfBuilder build_atrium();

}  // namespace lightloom::samples
