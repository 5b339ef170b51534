#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "framework/scene/lights.hpp"
#include "framework/scene/scene.hpp"
#include "framework/scene/texture_pages.hpp"

namespace lightloom::scene {

/// `TextureSlot` of shaders/lib/scene.glsl, std430.
struct GpuTextureSlot {
  uint32_t page = 0xFFFFFFFFu;
  uint32_t layer = 0;
  uint32_t texcoord = 0;
  uint32_t sampling = 0;  ///< bits 0-1 wrap u, 2-3 wrap v (0 repeat, 1 clamp, 2 mirror); bit 4: nearest
  glm::vec4 linear_transform{1, 0, 0, 1};  ///< column-major
  glm::vec2 offset{0};
  glm::vec2 reserved{0};
};
static_assert(sizeof(GpuTextureSlot) == 48 && offsetof(GpuTextureSlot, linear_transform) == 16 &&
              offsetof(GpuTextureSlot, offset) == 32);

/// `Material` of shaders/lib/scene.glsl, std430; see there for the meaning of each component.
struct GpuMaterial {
  glm::vec4 base_color{1};
  glm::vec4 emission{0};
  glm::vec4 surface{1, 1, 1, 1};
  glm::vec4 specular{1, 1, 1, 0};
  glm::vec4 shape{1, 0, 0.5f, 0.04f};
  glm::uvec4 flags{0};
  GpuTextureSlot base_color_texture, metallic_roughness_texture, normal_texture, emissive_texture, anisotropy_texture,
      specular_texture, specular_color_texture;
};
static_assert(offsetof(GpuMaterial, emission) == 16 && offsetof(GpuMaterial, surface) == 32 &&
              offsetof(GpuMaterial, specular) == 48);
static_assert(offsetof(GpuMaterial, shape) == 64 && offsetof(GpuMaterial, flags) == 80 &&
              offsetof(GpuMaterial, base_color_texture) == 96);
static_assert(offsetof(GpuMaterial, metallic_roughness_texture) == 144 && offsetof(GpuMaterial, normal_texture) == 192);
static_assert(offsetof(GpuMaterial, emissive_texture) == 240 && offsetof(GpuMaterial, anisotropy_texture) == 288);
static_assert(offsetof(GpuMaterial, specular_texture) == 336 && offsetof(GpuMaterial, specular_color_texture) == 384);
static_assert(sizeof(GpuMaterial) == 432);

/// One for each material of the scene, at least one so that a buffer of them is never empty.
[[nodiscard]] std::vector<GpuMaterial> pack_materials(const Scene& scene, const TexturePages& pages,
                                                      const EmissionTable& emission);

}  // namespace lightloom::scene
