#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lightloom::scene {

/// World-space vertex, laid out as `Vertex` in shaders/lib/scene.glsl (64 bytes, no padding).
struct Vertex {
  glm::vec3 position{0};  ///< [m]
  float u0 = 0;
  glm::vec3 normal{0, 1, 0};  ///< unit
  float v0 = 0;
  glm::vec4 tangent{1, 0, 0, 1};  ///< xyz unit; w = sign of the bitangent
  glm::vec2 uv1{0};
  uint32_t color = 0xFFFFFFFFu;  ///< linear RGBA8, red in the lowest byte
  uint32_t reserved = 0;
};
static_assert(sizeof(Vertex) == 64);

/// Corner indices into the vertices, and what the triangle belongs to.
struct Triangle {
  uint32_t a = 0, b = 0, c = 0;
  uint32_t material = 0;
  uint32_t object = 0;  ///< one id for each node instance that draws a mesh, counted from 0
};
static_assert(sizeof(Triangle) == 20);

enum class Wrap : uint8_t { repeat, clamp, mirror };

/// A use of an image by a material (glTF texture + sampler + KHR_texture_transform).
struct TextureUse {
  int32_t image = -1;  ///< index into Scene::images; -1: none
  uint32_t texcoord = 0;
  Wrap wrap_u = Wrap::repeat;
  Wrap wrap_v = Wrap::repeat;
  bool nearest = false;
  glm::mat2 linear_transform{1};
  glm::vec2 offset{0};
};

enum class AlphaMode : uint8_t { opaque, mask };  ///< BLEND is loaded as mask with cutoff 0.5, with a warning

struct Material {
  std::string name;
  glm::vec4 base_color{1};  ///< linear
  glm::vec3 emission{0};    ///< emissiveFactor * KHR_materials_emissive_strength [W·m⁻²·sr⁻¹]
  float metallic = 1;
  float roughness = 1;        ///< perceptual; Ward alpha = roughness²
  float specular_factor = 1;  ///< KHR_materials_specular
  glm::vec3 specular_color{1};
  float ior = 1.5f;        ///< KHR_materials_ior
  float transmission = 0;  ///< KHR_materials_transmission; surfaces with more than 0.5 are left out, with a warning
  float normal_scale = 1;
  float anisotropy_strength = 0;
  float anisotropy_rotation = 0;  ///< [radians], counter-clockwise from the tangent
  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha_cutoff = 0.5f;
  bool double_sided = false;
  bool unlit = false;
  TextureUse base_color_texture, metallic_roughness_texture, normal_texture, emissive_texture, anisotropy_texture,
      specular_texture, specular_color_texture;
};

/// Decoded 8-bit image, RGBA, row 0 first in the file (glTF's v = 0).
struct Image {
  std::string name;
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgba;
  bool srgb = false;  ///< used for colour (base colour, emission, specular colour)
};

struct Camera {
  std::string name;
  glm::mat4 world_from_camera{1};  ///< looks along -z; at time 0
  int32_t node = -1;               ///< node that carries it (for animation), or -1
  bool perspective = true;
  float vertical_fov = 0.8f;  ///< [radians]
  float half_height = 1;      ///< orthographic only [m]
};

struct Sun {
  glm::vec3 direction{0, -1, 0};  ///< unit, the direction the light travels in
  glm::vec3 irradiance{0};        ///< on a surface that faces the sun [W·m⁻²]
  float angular_radius = 0;       ///< [radians]
};

/// Radiance from outside the scene [W·m⁻²·sr⁻¹]: constant, or equirectangular image times `radiance` as scale.
/// Image rows go from +y (row 0) to -y; column 0 is longitude -pi, where longitude = atan2(z, x).
struct Environment {
  glm::vec3 radiance{0};
  uint32_t width = 0, height = 0;
  std::vector<float> rgb;  ///< width*height*3, empty for constant
};

enum class PunctualType : uint8_t { point, spot, directional };
struct PunctualLight {
  std::string name;
  PunctualType type = PunctualType::point;
  glm::vec3 intensity{1};  ///< colour * intensity, taken as [W·sr⁻¹] (directional: [W·m⁻²])
  float range = 0;         ///< [m]; 0 = unlimited
  float inner_cone = 0, outer_cone = 0.785398f;  ///< [radians]
  glm::vec3 position{0};                         ///< at time 0
  glm::vec3 direction{0, 0, -1};
  int32_t node = -1;
};

/// Facts of a scene that decide which code and which passes it needs. `named()` gives them to graphs ("scene.dynamic")
/// and to shaders ("has_dynamic").
struct Features {
  bool dynamic = false;   ///< some mesh moves or deforms
  bool emissive = false;  ///< some triangle emits
  bool sun = false;
  bool punctual = false;
  bool environment = false;  ///< non-black environment
  bool environment_image = false;
  bool textured = false;
  bool alpha = false;  ///< alpha-masked material
  bool normal_mapped = false;
  bool specular = false;  ///< some material reflects specularly
  bool anisotropic = false;
  bool metallic = false;
  [[nodiscard]] std::vector<std::pair<std::string, bool>> named() const;
};

struct Bounds {
  glm::vec3 min{0};
  glm::vec3 max{0};
};

struct SceneSource;  // nodes, skins, morph targets, clips: what posing needs (scene/pose.cpp)

/// A loaded scene. Geometry in world space less `origin`, as are cameras, punctual lights and bounds, here, on the
/// device and in all that passes write: floats resolve 1 m at a distance of 1e7 m, so a scene that lies far off for its
/// size is loaded as if it did not (framework/scene/origin.hpp). Triangles [0, static_triangle_count) never move; the
/// vertices of the rest, [static_vertex_count, vertices.size()), are those at time 0 and are re-posed by `pose`.
struct Scene {
  std::filesystem::path file;
  glm::dvec3 origin{0};  ///< [m], where in the world the coordinates of the scene have their zero
  std::vector<Vertex> vertices;
  std::vector<Triangle> triangles;
  uint32_t static_vertex_count = 0;
  uint32_t static_triangle_count = 0;
  std::vector<Material> materials;
  std::vector<Image> images;
  std::vector<std::string> objects;  ///< names by object id
  std::vector<Camera>
      cameras;  ///< at least one; scene-file cameras first, then the glTF file's, else a made-up "default"
  std::optional<Sun> sun;
  Environment environment;
  std::vector<PunctualLight> punctual;
  Features features;
  Bounds bounds;        ///< over all geometry and the whole of every animation
  double duration = 0;  ///< longest clip [s]; 0 if nothing is animated
  std::vector<std::string> warnings;
  std::shared_ptr<const SceneSource> source;
};

/// What moves, at one moment.
struct Pose {
  std::vector<Vertex> dynamic_vertices;  ///< replaces vertices[static_vertex_count..]
  std::vector<Camera> cameras;           ///< parallel to Scene::cameras
  std::vector<PunctualLight> punctual;   ///< parallel to Scene::punctual
};

/// Loads `.gltf`, `.glb` or `*.scene.json`. Throws Error(invalid_input) with one sentence that names the file and the
/// element ("materials[3].pbrMetallicRoughness.roughnessFactor"); never crashes on broken input.
[[nodiscard]] Scene load_scene(const std::filesystem::path& file);

/// Pose at `time` [s]; clips repeat.
[[nodiscard]] Pose pose(const Scene& scene, double time);

}  // namespace lightloom::scene
