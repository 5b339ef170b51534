#pragma once

#include "framework/scene/gltf_asset.hpp"
#include "framework/scene/scene_file.hpp"

namespace lightloom::scene {

/// Puts the instances of a scene file together: nodes, clips, materials, images, cameras, lights, and the triangles,
/// static ones first. Bounds and features are left open. Throws Error.
[[nodiscard]] Scene assemble(const std::filesystem::path& path, const SceneFile& file, const LoadOptions& options);

}  // namespace lightloom::scene
