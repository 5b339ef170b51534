#include <glm/glm.hpp>

#include "framework/scene/assemble.hpp"
#include "framework/scene/fail.hpp"
#include "framework/scene/finish.hpp"
#include "framework/scene/load_options.hpp"
#include "framework/scene/origin.hpp"
#include "framework/scene/texture_pages.hpp"

namespace lightloom::scene {
namespace {

SceneFile describe_file(const std::filesystem::path& file, const LoadOptions& options) {
  const std::string name = file.filename().string();
  const std::string extension = file.extension().string();
  if (name.ends_with(".json")) return read_scene_file(file, options);
  if (extension != ".gltf" && extension != ".glb") {
    throw Error(ExitCode::invalid_input,
                file.string() + ": the file name ends with '" + extension + "', expected .gltf, .glb or .scene.json");
  }
  SceneFile result;
  result.instances.emplace_back().gltf = file;
  return result;
}

bool has_light(const Features& features) {
  return features.emissive || features.sun || features.punctual || features.environment;
}

/// What a model without light of its own is shown under: an even white sky [W·m⁻²·sr⁻¹] and a sun from the upper left
/// of the made-up camera [W·m⁻²], wide enough to show as a highlight on smooth metal [radians].
constexpr float kModelSky = 0.3f;
constexpr float kModelSunIrradiance = 2.0f;
constexpr float kModelSunRadius = 0.03f;
const glm::vec3 kModelSunDirection(0.35f, -1.0f, -0.6f);

/// A glTF file is often a model for others to light: without a camera, or with nothing that emits. Viewers show such a
/// file under a light of their own, and so do we, or a lamp seen from above its shade would be a black picture. A scene
/// file says itself what light there is, and so does a glTF file with punctual lights.
bool needs_model_light(const Scene& scene, bool scene_file) {
  if (scene_file || !scene.punctual.empty()) return false;
  return scene.cameras.empty() || !has_light(scene.features);
}

/// A file with a hundred thousand elements can be wrong a hundred thousand times.
void shorten_warnings(std::vector<std::string>& warnings) {
  constexpr size_t kMost = 100;
  if (warnings.size() <= kMost) return;
  const size_t more = warnings.size() - kMost;
  warnings.resize(kMost);
  warnings.push_back("and " + std::to_string(more) + " more warnings about the scene");
}

}  // namespace

Scene load_scene(const std::filesystem::path& file) {
  return load_scene(file, {});
}

Scene load_scene(const std::filesystem::path& file, const LoadOptions& options) {
  const bool scene_file = file.extension() == ".json";
  Scene scene = assemble(file, describe_file(file, options), options);
  require_texture_pages_within(scene, options.limits);
  scene.bounds = find_bounds(scene, options.limits);
  scene.features = find_features(scene);
  if (needs_model_light(scene, scene_file)) {
    scene.environment.radiance = glm::vec3(kModelSky);
    scene.sun = Sun{.direction = glm::normalize(kModelSunDirection),
                    .irradiance = glm::vec3(kModelSunIrradiance),
                    .angular_radius = kModelSunRadius};
    scene.features = find_features(scene);
    scene.warnings.push_back(file.string() +
                             ": is a model without camera or light of its own, and is shown under a white sky and a "
                             "sun; a scene file can give it others");
  }
  if (scene.cameras.empty()) scene.cameras.push_back(framing_camera(scene.bounds));
  if (std::string warning = far_outlier_warning(scene); !warning.empty()) scene.warnings.push_back(std::move(warning));
  if (!has_light(scene.features)) {
    scene.warnings.push_back(
        "the scene has no light: give it a sun or an environment in a scene file, or everything is black");
  }
  shorten_warnings(scene.warnings);
  return scene;
}

}  // namespace lightloom::scene
