#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "framework/reference/bsdf.hpp"
#include "framework/reference/textures.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::reference {

/// A material at one point.
struct MaterialPoint {
  Reflectance reflectance;
  glm::vec3 emission{0};      ///< [W m^-2 sr^-1]
  glm::vec3 normal{0, 0, 1};  ///< unit, in the frame (tangent, bitangent, normal)
  glm::vec2 direction{1, 0};  ///< unit, of the lobe's x axis in the frame (tangent, bitangent)
};

/// The materials of a scene, with glTF's metallic-roughness model turned into Ward lobes: alpha = roughness^2, by
/// KHR_materials_anisotropy mix(alpha, 1, strength^2) along the direction, F0 and F90 by KHR_materials_specular and
/// _ior (the colour factor counts by its luminance). Keeps a reference to the scene.
class Materials {
 public:
  explicit Materials(const scene::Scene& scene);

  struct Traits {
    bool constant = true;  ///< the same everywhere, but for vertex colours
    bool masked = false;   ///< parts of it may be cut out
    bool emits = false;
    bool double_sided = false;
    bool unlit = false;
    bool needs_tangent = false;  ///< has a normal map or an anisotropic lobe
  };
  [[nodiscard]] const Traits& traits(uint32_t material) const { return traits_[material]; }

  [[nodiscard]] MaterialPoint at(uint32_t material, const TexturePoint& point, const glm::vec4& vertex_color) const;
  [[nodiscard]] bool cut_out(uint32_t material, const TexturePoint& point, const glm::vec4& vertex_color) const;
  [[nodiscard]] glm::vec3 emission(uint32_t material, const TexturePoint& point) const;

 private:
  [[nodiscard]] glm::vec4 texel(const scene::TextureUse& use, bool srgb, const TexturePoint& point,
                                const glm::vec4& missing) const;
  [[nodiscard]] MaterialPoint evaluate(uint32_t material, const TexturePoint& point) const;
  void set_lobe(const scene::Material& material, const TexturePoint& point, float roughness,
                MaterialPoint& result) const;
  void set_fresnel(const scene::Material& material, const TexturePoint& point, Reflectance& result) const;
  [[nodiscard]] glm::vec3 mapped_normal(const scene::Material& material, const TexturePoint& point) const;

  const scene::Scene* scene_;
  Textures textures_;
  std::vector<Traits> traits_;
  std::vector<MaterialPoint> constants_;  ///< by material, for those that are
};

}  // namespace lightloom::reference
