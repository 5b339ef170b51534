#include "framework/scene/describe.hpp"

#include <sstream>

#include "framework/base/text.hpp"
#include "framework/scene/finish.hpp"
#include "framework/scene/source.hpp"

namespace lightloom::scene {
namespace {

std::string shown(const glm::vec3& v) {
  std::ostringstream out;
  out.precision(5);
  out << "(" << v.x << ", " << v.y << ", " << v.z << ")";
  return out.str();
}

std::string list_or_none(const std::vector<std::string>& names) {
  return names.empty() ? "none" : join(names, ", ");
}

}  // namespace

SceneSummary summarise(const Scene& scene) {
  SceneSummary summary;
  summary.file = scene.file.string();
  summary.static_triangles = scene.static_triangle_count;
  summary.dynamic_triangles = scene.triangles.size() - scene.static_triangle_count;
  summary.vertices = scene.vertices.size();
  summary.objects = scene.objects.size();
  summary.materials = scene.materials.size();
  std::vector<bool> emissive;
  for (const Material& material : scene.materials) emissive.push_back(emits(scene, material));
  for (const Triangle& triangle : scene.triangles) summary.emissive_triangles += emissive[triangle.material] ? 1u : 0u;
  for (const Image& image : scene.images) summary.images.push_back({image.name, image.width, image.height, image.srgb});
  for (const Camera& camera : scene.cameras) summary.cameras.push_back(camera.name);
  for (const PunctualLight& light : scene.punctual)
    summary.punctual_lights.push_back(light.name.empty() ? "unnamed" : light.name);
  summary.animated_clips = scene.source ? scene.source->clips.size() : 0;
  summary.duration = scene.duration;
  summary.bounds = scene.bounds;
  summary.features = scene.features.named();
  summary.warnings = scene.warnings;
  return summary;
}

std::string describe(const Scene& scene) {
  const SceneSummary summary = summarise(scene);
  std::vector<std::string> features;
  for (const auto& [name, present] : summary.features) {
    if (present) features.push_back(name);
  }
  std::vector<std::string> lights = summary.punctual_lights;
  if (scene.features.sun) lights.emplace_back("sun");
  if (scene.features.environment) lights.emplace_back("environment");
  if (scene.features.emissive) lights.emplace_back("emissive surfaces");
  std::ostringstream out;
  out << summary.file << "\n"
      << "  triangles   " << summary.static_triangles << " static, " << summary.dynamic_triangles << " dynamic, "
      << summary.emissive_triangles << " of them emissive\n"
      << "  vertices    " << summary.vertices << "\n"
      << "  objects     " << summary.objects << "\n"
      << "  materials   " << summary.materials << "\n"
      << "  cameras     " << list_or_none(summary.cameras) << "\n"
      << "  lights      " << list_or_none(lights) << "\n"
      << "  animations  " << summary.animated_clips << " playing, longest " << summary.duration << " s\n"
      << "  bounds      " << shown(summary.bounds.min) << " to " << shown(summary.bounds.max) << " m\n"
      << "  features    " << list_or_none(features) << "\n"
      << "  images      " << summary.images.size() << "\n";
  for (const ImageSummary& image : summary.images) {
    out << "    " << image.width << " x " << image.height << (image.srgb ? " colour  " : " data    ") << image.name
        << "\n";
  }
  for (const std::string& warning : summary.warnings) out << "  warning: " << warning << "\n";
  return out.str();
}

}  // namespace lightloom::scene
