#include <algorithm>

#include "framework/scene/finish.hpp"
#include "framework/scene/gltf_materials.hpp"

namespace lightloom::scene {

std::vector<std::pair<std::string, bool>> Features::named() const {
  return {{"dynamic", dynamic},
          {"emissive", emissive},
          {"sun", sun},
          {"punctual", punctual},
          {"environment", environment},
          {"environment_image", environment_image},
          {"textured", textured},
          {"alpha", alpha},
          {"normal_mapped", normal_mapped},
          {"specular", specular},
          {"anisotropic", anisotropic},
          {"metallic", metallic}};
}

bool is_black(const Image& image) {
  for (size_t i = 0; i + 3 < image.rgba.size(); i += 4) {
    if (image.rgba[i] != 0 || image.rgba[i + 1] != 0 || image.rgba[i + 2] != 0) return false;
  }
  return true;
}

bool emits(const Scene& scene, const Material& material) {
  if (material.emission == glm::vec3(0)) return false;
  const int32_t image = material.emissive_texture.image;
  return image < 0 || !is_black(scene.images[static_cast<size_t>(image)]);
}

namespace {

// A dielectric reflects nothing specularly only if its weight or its F0 colour is zero.
bool reflects_specularly(const Material& material) {
  if (material.unlit) return false;
  const bool dielectric = material.specular_factor > 0 && material.ior != 1.0f;
  return material.metallic > 0 || dielectric;
}

void add_material(const Scene& scene, Material material, Features& features) {
  features.emissive = features.emissive || emits(scene, material);
  features.alpha = features.alpha || material.alpha_mode == AlphaMode::mask;
  features.metallic = features.metallic || (material.metallic > 0 && !material.unlit);
  features.normal_mapped = features.normal_mapped || material.normal_texture.image >= 0;
  features.specular = features.specular || reflects_specularly(material);
  features.anisotropic = features.anisotropic || (material.anisotropy_strength > 0 && reflects_specularly(material));
  for (const TextureUseRef& ref : texture_uses(material)) features.textured = features.textured || ref.use->image >= 0;
}

}  // namespace

Features find_features(const Scene& scene) {
  Features features;
  features.dynamic = scene.static_triangle_count < scene.triangles.size();
  features.sun = scene.sun && scene.sun->irradiance != glm::vec3(0);
  features.punctual = std::any_of(scene.punctual.begin(), scene.punctual.end(),
                                  [](const PunctualLight& light) { return light.intensity != glm::vec3(0); });
  const bool black_image =
      std::all_of(scene.environment.rgb.begin(), scene.environment.rgb.end(), [](float value) { return value == 0; });
  const bool has_image = !scene.environment.rgb.empty();
  features.environment = scene.environment.radiance != glm::vec3(0) && !(has_image && black_image);
  features.environment_image = features.environment && has_image;
  std::vector<bool> used(scene.materials.size(), false);
  for (const Triangle& triangle : scene.triangles) used[triangle.material] = true;
  for (size_t m = 0; m < used.size(); ++m) {
    if (used[m]) add_material(scene, scene.materials[m], features);
  }
  return features;
}

}  // namespace lightloom::scene
