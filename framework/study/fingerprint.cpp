#include "framework/study/fingerprint.hpp"

#include <algorithm>
#include <type_traits>

#include "framework/base/file.hpp"
#include "framework/base/hash.hpp"
#include "framework/run/version.hpp"

namespace lightloom::study {
namespace {

constexpr uint64_t kFolderFormat = 1;

class SceneHasher {
 public:
  template <typename T>
  void list(const std::vector<T>& values) {
    static_assert(std::has_unique_object_representations_v<T> || std::is_same_v<T, float> ||
                  std::is_same_v<T, scene::Vertex>);  // the vertex is floats without padding
    hasher_.number(values.size());
    hasher_.bytes(values.data(), values.size() * sizeof(T));
  }
  template <int N>
  void vector(const glm::vec<N, float>& value) {
    for (int i = 0; i < N; ++i) hasher_.real(value[i]);
  }
  void material(const scene::Material& material) {
    hasher_.text(material.name);
    vector(material.base_color);
    vector(material.emission);
    vector(material.specular_color);
    for (const float value :
         {material.metallic, material.roughness, material.specular_factor, material.ior, material.transmission,
          material.normal_scale, material.anisotropy_strength, material.anisotropy_rotation, material.alpha_cutoff})
      hasher_.real(value);
    hasher_.number(static_cast<uint64_t>(material.alpha_mode));
    hasher_.number((material.double_sided ? 1U : 0U) + (material.unlit ? 2U : 0U));
    for (const scene::TextureUse* use :
         {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture,
          &material.emissive_texture, &material.anisotropy_texture, &material.specular_texture,
          &material.specular_color_texture})
      texture(*use);
  }
  void image(const scene::Image& image) {
    hasher_.number(image.width);
    hasher_.number(image.height);
    hasher_.number(image.srgb ? 1 : 0);
    list(image.rgba);
  }
  void camera(const scene::Camera& camera) {
    hasher_.text(camera.name);
    for (int column = 0; column < 4; ++column) vector(camera.world_from_camera[column]);
    hasher_.number(camera.perspective ? 1 : 0);
    hasher_.real(camera.vertical_fov);
    hasher_.real(camera.half_height);
  }
  void light(const scene::PunctualLight& light) {
    hasher_.number(static_cast<uint64_t>(light.type));
    for (const glm::vec3& value : {light.intensity, light.position, light.direction}) vector(value);
    for (const float value : {light.range, light.inner_cone, light.outer_cone}) hasher_.real(value);
  }
  void surroundings(const scene::Scene& scene) {
    hasher_.number(scene.sun ? 1 : 0);
    if (scene.sun) {
      vector(scene.sun->direction);
      vector(scene.sun->irradiance);
      hasher_.real(scene.sun->angular_radius);
    }
    vector(scene.environment.radiance);
    hasher_.number(scene.environment.width);
    list(scene.environment.rgb);
    vector(scene.bounds.min);
    vector(scene.bounds.max);
  }
  Hasher& hasher() { return hasher_; }

 private:
  void texture(const scene::TextureUse& use) {
    hasher_.number(static_cast<uint64_t>(int64_t{use.image}));
    hasher_.number(use.texcoord);
    hasher_.number(static_cast<uint64_t>(use.wrap_u));
    hasher_.number(static_cast<uint64_t>(use.wrap_v));
    hasher_.number(use.nearest ? 1 : 0);
    vector(use.linear_transform[0]);
    vector(use.linear_transform[1]);
    vector(use.offset);
  }
  Hasher hasher_;
};

}  // namespace

uint64_t scene_hash(const scene::Scene& scene) {
  SceneHasher hash;
  hash.list(scene.vertices);
  hash.list(scene.triangles);
  hash.hasher().number(scene.static_vertex_count);
  hash.hasher().number(scene.static_triangle_count);
  for (const scene::Material& material : scene.materials) hash.material(material);
  for (const scene::Image& image : scene.images) hash.image(image);
  for (const scene::Camera& camera : scene.cameras) hash.camera(camera);
  for (const scene::PunctualLight& light : scene.punctual) hash.light(light);
  hash.surroundings(scene);
  return hash.hasher().value();
}

uint64_t motion_hash(const scene::Scene& scene, const std::vector<double>& times) {
  if (scene.duration == 0) return 0;
  SceneHasher hash;
  for (const double time : times) {
    const scene::Pose pose = scene::pose(scene, time);
    hash.list(pose.dynamic_vertices);
    for (const scene::Camera& camera : pose.cameras) hash.camera(camera);
    for (const scene::PunctualLight& light : pose.punctual) hash.light(light);
  }
  return hash.hasher().value();
}

uint64_t code_hash(const std::vector<std::filesystem::path>& folders, const std::vector<std::filesystem::path>& files) {
  Hasher hasher;
  for (const std::filesystem::path& folder : folders) {
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
      if (entry.is_regular_file()) found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    for (const std::filesystem::path& file : found) {
      hasher.text(file.lexically_relative(folder).generic_string());
      hasher.text(read_text_file(file));
    }
  }
  for (const std::filesystem::path& file : files) hasher.text(read_text_file(file));
  return hasher.value();
}

std::string cell_key(const RenderIdentity& identity, const gpu::DeviceInfo& device) {
  Hasher hasher;
  hasher.number(kFolderFormat);
  for (const std::string& text : {run::version(), run::commit(), device.name, device.driver, device.driver_info})
    hasher.text(text);
  hasher.number(plan_hash(*identity.plan));
  for (const GraphPass& pass : identity.plan->graph.passes) {
    hasher.text(pass.name);
    hasher.text(pass.type->name);
    hasher.number(pass.type->version);
  }
  hasher.number(identity.scene_hash);
  std::vector<double> times;
  for (uint32_t i = 0; i < identity.frames; ++i)
    times.push_back((identity.first_frame + i) / identity.frames_per_second);
  hasher.number(motion_hash(*identity.scene, times));
  hasher.text(identity.camera);
  for (const uint32_t number : {identity.seed, identity.first_frame, identity.frames, identity.kept})
    hasher.number(number);
  hasher.real(identity.frames_per_second);
  hasher.text(identity.output);
  hasher.number(identity.code_hash);
  return hex(hasher.value());
}

}  // namespace lightloom::study
