#include "framework/scene/gpu_material.hpp"

#include <cmath>

#include "framework/scene/gltf_materials.hpp"

namespace lightloom::scene {
namespace {

uint32_t wrap_bits(Wrap wrap) {
  return wrap == Wrap::clamp ? 1u : wrap == Wrap::mirror ? 2u : 0u;
}

GpuTextureSlot pack_slot(const TextureUse& use, const std::vector<TexturePlace>& places) {
  GpuTextureSlot slot;
  if (use.image < 0) return slot;
  const TexturePlace& place = places[static_cast<size_t>(use.image)];
  slot.page = place.page;
  slot.layer = place.layer;
  slot.texcoord = use.texcoord;
  slot.sampling = wrap_bits(use.wrap_u) | wrap_bits(use.wrap_v) << 2 | (use.nearest ? 16u : 0u);
  slot.linear_transform = glm::vec4(use.linear_transform[0], use.linear_transform[1]);
  slot.offset = use.offset;
  return slot;
}

GpuMaterial pack(const Material& material, const TexturePages& pages, const EmissionTable& emission, uint32_t index) {
  const uint32_t entry = emission.entry_of_material[index];
  GpuMaterial packed;
  packed.base_color = material.base_color;
  packed.emission = entry == 0 ? glm::vec4(0) : glm::vec4(material.emission, emission.entries[entry].threshold);
  packed.surface = {material.metallic, material.roughness, material.specular_factor, material.normal_scale};
  packed.specular = glm::vec4(material.specular_color, material.anisotropy_strength);
  packed.shape = {std::cos(material.anisotropy_rotation), std::sin(material.anisotropy_rotation), material.alpha_cutoff,
                  dielectric_f0(material.ior)};
  packed.flags = {material.alpha_mode == AlphaMode::mask ? 1u : 0u, material.double_sided ? 1u : 0u, entry,
                  material.unlit ? 1u : 0u};
  packed.base_color_texture = pack_slot(material.base_color_texture, pages.srgb_places);
  packed.metallic_roughness_texture = pack_slot(material.metallic_roughness_texture, pages.linear_places);
  packed.normal_texture = pack_slot(material.normal_texture, pages.linear_places);
  packed.emissive_texture = pack_slot(material.emissive_texture, pages.srgb_places);
  packed.anisotropy_texture = pack_slot(material.anisotropy_texture, pages.linear_places);
  packed.specular_texture = pack_slot(material.specular_texture, pages.linear_places);
  packed.specular_color_texture = pack_slot(material.specular_color_texture, pages.srgb_places);
  return packed;
}

}  // namespace

std::vector<GpuMaterial> pack_materials(const Scene& scene, const TexturePages& pages, const EmissionTable& emission) {
  std::vector<GpuMaterial> packed;
  for (uint32_t m = 0; m < scene.materials.size(); ++m) packed.push_back(pack(scene.materials[m], pages, emission, m));
  if (packed.empty()) packed.emplace_back();
  return packed;
}

}  // namespace lightloom::scene
