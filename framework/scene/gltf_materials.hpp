#pragma once

#include <string>
#include <vector>

#include "framework/scene/gltf_file.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::scene {

/// Materials of a file; `image` of their textures are indices into the file's images. Throws Error.
[[nodiscard]] std::vector<Material> load_materials(const GltfFile& file, std::vector<std::string>& warnings);

/// All texture uses of a material, and which of them are colours (in sRGB).
struct TextureUseRef {
  TextureUse* use;
  bool srgb;
};
[[nodiscard]] std::vector<TextureUseRef> texture_uses(Material& material);

/// Reflectance at normal incidence of a dielectric: ((ior - 1) / (ior + 1))^2; 1 for an ior of 0 (KHR_materials_ior).
[[nodiscard]] float dielectric_f0(float ior);

/// Whether light goes through rather than off the surface: glass. Nothing here refracts, so such surfaces would only
/// be opaque walls around what they let be seen.
[[nodiscard]] inline bool transmits(const Material& material) {
  return material.transmission > 0.5f;
}

}  // namespace lightloom::scene
