#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/scene/gltf_file.hpp"
#include "framework/scene/gltf_nodes.hpp"
#include "framework/scene/primitive.hpp"
#include "framework/scene/source.hpp"

namespace lightloom::scene {

/// Everything of one glTF file, checked and converted; instances share it. Indices are those of the file.
struct GltfAsset {
  GltfFile file;
  NodeOrder order;
  std::vector<SourceNode> nodes;                                      ///< morph weights included
  std::vector<std::vector<std::shared_ptr<const Primitive>>> meshes;  ///< primitives by mesh
  std::vector<SourceSkin> skins;
  std::vector<Clip> animations;
  std::vector<Material> materials;  ///< texture images index `images`
  std::vector<Image> images;        ///< those that materials use
  std::vector<std::string> warnings;
};

/// Loads all of a file. Throws Error.
[[nodiscard]] GltfAsset load_asset(const std::filesystem::path& path, InputContext& context);

/// Cameras and lights of a file, by its camera and light index; `node` stays -1.
[[nodiscard]] Camera load_camera(const GltfFile& file, int index);
[[nodiscard]] PunctualLight load_light(const GltfFile& file, int index);

}  // namespace lightloom::scene
