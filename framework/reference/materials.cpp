#include "framework/reference/materials.hpp"

#include <algorithm>
#include <cmath>

namespace lightloom::reference {
namespace {

constexpr float kLeastAlpha = 1e-3f;

Materials::Traits traits_of(const scene::Scene& scene, const scene::Material& material) {
  Materials::Traits traits;
  for (const scene::TextureUse* use :
       {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture,
        &material.emissive_texture, &material.anisotropy_texture, &material.specular_texture,
        &material.specular_color_texture})
    traits.constant = traits.constant && use->image < 0;
  traits.masked = material.alpha_mode == scene::AlphaMode::mask;
  traits.emits = material.emission != glm::vec3(0);
  traits.double_sided = material.double_sided;
  traits.unlit = material.unlit;
  const bool anisotropic = scene.features.specular && material.anisotropy_strength > 0;
  traits.needs_tangent = material.normal_texture.image >= 0 || anisotropic;
  return traits;
}

}  // namespace

Materials::Materials(const scene::Scene& scene) : scene_(&scene), textures_(scene) {
  for (uint32_t m = 0; m < scene.materials.size(); ++m) {
    traits_.push_back(traits_of(scene, scene.materials[m]));
    constants_.push_back(traits_.back().constant ? evaluate(m, {}) : MaterialPoint{});
  }
}

glm::vec4 Materials::texel(const scene::TextureUse& use, bool srgb, const TexturePoint& point,
                           const glm::vec4& missing) const {
  return use.image < 0 ? missing : textures_.sample(use, srgb, point);
}

glm::vec3 Materials::emission(uint32_t material, const TexturePoint& point) const {
  const scene::Material& source = scene_->materials[material];
  return source.emission * glm::vec3(texel(source.emissive_texture, true, point, glm::vec4(1)));
}

bool Materials::cut_out(uint32_t material, const TexturePoint& point, const glm::vec4& vertex_color) const {
  if (!traits_[material].masked) return false;
  const scene::Material& source = scene_->materials[material];
  const float alpha =
      source.base_color.a * vertex_color.a * texel(source.base_color_texture, true, point, glm::vec4(1)).a;
  return alpha < source.alpha_cutoff;
}

void Materials::set_lobe(const scene::Material& material, const TexturePoint& point, float roughness,
                         MaterialPoint& result) const {
  glm::vec2 alpha(roughness * roughness);
  if (material.anisotropy_strength > 0) {
    const glm::vec4 value = texel(material.anisotropy_texture, false, point, {1, 0.5f, 1, 1});
    const glm::vec2 turn(std::cos(material.anisotropy_rotation), std::sin(material.anisotropy_rotation));
    const glm::vec2 direction = glm::vec2(value) * 2.0f - 1.0f;
    const glm::vec2 turned(turn.x * direction.x - turn.y * direction.y, turn.y * direction.x + turn.x * direction.y);
    const float squared = glm::dot(turned, turned);
    result.direction = squared > 1e-8f ? turned / std::sqrt(squared) : turn;
    const float strength = std::clamp(material.anisotropy_strength * value.z, 0.0f, 1.0f);
    alpha.x += (1 - alpha.x) * strength * strength;
  }
  result.reflectance.alpha = glm::clamp(alpha, kLeastAlpha, 1.0f);
}

void Materials::set_fresnel(const scene::Material& material, const TexturePoint& point, Reflectance& result) const {
  const float index_step = (material.ior - 1) / (material.ior + 1);
  result.f90 = material.specular_factor * texel(material.specular_texture, false, point, glm::vec4(1)).a;
  const glm::vec3 color =
      material.specular_color * glm::vec3(texel(material.specular_color_texture, true, point, glm::vec4(1)));
  const float luminance = glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f));
  result.f0 = std::min(index_step * index_step * luminance, 1.0f) * result.f90;
}

glm::vec3 Materials::mapped_normal(const scene::Material& material, const TexturePoint& point) const {
  if (material.normal_texture.image < 0) return {0, 0, 1};
  glm::vec3 normal = glm::vec3(textures_.sample(material.normal_texture, false, point)) * 2.0f - 1.0f;
  normal.x *= material.normal_scale;
  normal.y *= material.normal_scale;
  const float squared = glm::dot(normal, normal);
  return squared > 1e-8f ? normal / std::sqrt(squared) : glm::vec3(0, 0, 1);
}

MaterialPoint Materials::evaluate(uint32_t material, const TexturePoint& point) const {
  const scene::Material& source = scene_->materials[material];
  MaterialPoint result;
  const glm::vec4 metal_rough = texel(source.metallic_roughness_texture, false, point, glm::vec4(1));
  result.reflectance.base_color =
      glm::vec3(source.base_color) * glm::vec3(texel(source.base_color_texture, true, point, glm::vec4(1)));
  result.reflectance.metallic = std::clamp(source.metallic * metal_rough.b, 0.0f, 1.0f);
  set_lobe(source, point, std::clamp(source.roughness * metal_rough.g, 0.0f, 1.0f), result);
  // A scene in which nothing reflects specularly has no lobes at all, also not at an index of refraction of 1, where
  // only Schlick's approximation leaves something at grazing angles.
  if (scene_->features.specular) set_fresnel(source, point, result.reflectance);
  result.emission = emission(material, point);
  result.normal = mapped_normal(source, point);
  return result;
}

MaterialPoint Materials::at(uint32_t material, const TexturePoint& point, const glm::vec4& vertex_color) const {
  MaterialPoint result = traits_[material].constant ? constants_[material] : evaluate(material, point);
  result.reflectance.base_color *= glm::vec3(vertex_color);
  return result;
}

}  // namespace lightloom::reference
