#include "framework/stability/scene_files.hpp"

#include <algorithm>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "framework/base/atomic_file.hpp"

namespace lightloom::stability {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFloat = 5126;
constexpr int kVec3Floats = 3;

template <int N, typename T>
Json json_of(const glm::vec<N, T>& vector) {
  Json list = Json::array();
  for (int i = 0; i < N; ++i) list.push_back(vector[i]);
  return list;
}

/// One buffer with accessors of three floats an element.
class Buffer {
 public:
  int add(const std::vector<glm::vec3>& values) {
    const size_t offset = bytes_.size(), size = values.size() * sizeof(glm::vec3);
    bytes_.resize(offset + size);
    std::memcpy(bytes_.data() + offset, values.data(), size);
    glm::vec3 low = values.front(), high = values.front();
    for (const glm::vec3& value : values) {
      low = glm::min(low, value);
      high = glm::max(high, value);
    }
    const size_t index = views_.size();
    views_.push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}});
    accessors_.push_back({{"bufferView", index},
                          {"componentType", kFloat},
                          {"type", "VEC" + std::to_string(kVec3Floats)},
                          {"count", values.size()},
                          {"min", json_of(low)},
                          {"max", json_of(high)}});
    return static_cast<int>(index);
  }

  void finish(Json& gltf, const std::filesystem::path& file) const {
    gltf["buffers"] = {{{"uri", file.filename().string()}, {"byteLength", bytes_.size()}}};
    gltf["bufferViews"] = views_;
    gltf["accessors"] = accessors_;
    write_file_atomically(file, std::string_view(bytes_));
  }

 private:
  std::string bytes_;
  Json views_ = Json::array(), accessors_ = Json::array();
};

Json material_json(const scene::Material& material) {
  const float strongest = std::max({material.emission.x, material.emission.y, material.emission.z, 1.0f});
  return {{"pbrMetallicRoughness",
           {{"baseColorFactor", json_of(material.base_color)},
            {"metallicFactor", material.metallic},
            {"roughnessFactor", material.roughness}}},
          {"emissiveFactor", json_of(material.emission / strongest)},
          {"doubleSided", material.double_sided},
          {"extensions",
           {{"KHR_materials_specular", {{"specularFactor", material.specular_factor}}},
            {"KHR_materials_emissive_strength", {{"emissiveStrength", strongest}}}}}};
}

Json primitives_of(const scene::Scene& scene, const std::vector<glm::vec3>& raw_triangles, Buffer& buffer) {
  std::map<uint32_t, std::vector<glm::vec3>> corners;
  for (const scene::Triangle& triangle : scene.triangles)
    for (const uint32_t corner : {triangle.a, triangle.b, triangle.c})
      corners[triangle.material].push_back(scene.vertices[corner].position);
  Json primitives = Json::array();
  for (const auto& [material, positions] : corners)
    primitives.push_back({{"attributes", {{"POSITION", buffer.add(positions)}}}, {"material", material}});
  if (!raw_triangles.empty())
    primitives.push_back({{"attributes", {{"POSITION", buffer.add(raw_triangles)}}}, {"material", 0}});
  return primitives;
}

}  // namespace

std::filesystem::path write_scene(const std::filesystem::path& folder, const std::string& name,
                                  const scene::Scene& scene, const glm::dvec3& shift,
                                  const std::vector<glm::vec3>& raw_triangles) {
  Buffer buffer;
  Json gltf = {{"asset", {{"version", "2.0"}}},
               {"extensionsUsed", {"KHR_materials_specular", "KHR_materials_emissive_strength"}}};
  gltf["meshes"] = {{{"primitives", primitives_of(scene, raw_triangles, buffer)}}};
  gltf["materials"] = Json::array();
  for (const scene::Material& material : scene.materials) gltf["materials"].push_back(material_json(material));
  gltf["nodes"] = {{{"mesh", 0}, {"translation", json_of(shift)}}};
  gltf["scenes"] = {{{"nodes", {0}}}};
  gltf["scene"] = 0;
  buffer.finish(gltf, folder / (name + ".bin"));
  write_file_atomically(folder / (name + ".gltf"), gltf.dump());

  const scene::Camera& camera = scene.cameras.front();
  const glm::dvec3 eye = glm::dvec3(camera.world_from_camera[3]) + shift;
  const glm::dvec3 forward(-camera.world_from_camera[2]);
  // The target in whole units of 2^-20, which doubles hold exactly at every distance that is asked for.
  const glm::dvec3 target = eye + glm::round(forward * 1048576.0) / 1048576.0;
  const Json file = {{"lightloom_scene", 1},
                     {"gltf", name + ".gltf"},
                     {"cameras",
                      {{"camera",
                        {{"eye", json_of(eye)},
                         {"target", json_of(target)},
                         {"vertical_fov_degrees", glm::degrees(static_cast<double>(camera.vertical_fov))}}}}}};
  write_file_atomically(folder / (name + ".scene.json"), file.dump());
  return folder / (name + ".scene.json");
}

}  // namespace lightloom::stability
