#include "framework/stability/scenes.hpp"

#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <utility>

namespace lightloom::stability {
namespace {

void add_quad(scene::Scene& target, const QuadSpec& quad) {
  const glm::vec3 normal = glm::normalize(glm::cross(quad.edge_u, quad.edge_v));
  const auto base = static_cast<uint32_t>(target.vertices.size());
  const auto object = static_cast<uint32_t>(target.objects.size());
  for (const glm::vec2 uv : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
    scene::Vertex vertex;
    vertex.position = quad.corner + uv.x * quad.edge_u + uv.y * quad.edge_v;
    vertex.normal = normal;
    vertex.tangent = glm::vec4(glm::normalize(quad.edge_u), 1);
    vertex.u0 = uv.x;
    vertex.v0 = uv.y;
    target.vertices.push_back(vertex);
    target.bounds.min = glm::min(target.bounds.min, vertex.position);
    target.bounds.max = glm::max(target.bounds.max, vertex.position);
  }
  target.triangles.push_back({base, base + 1, base + 2, quad.material, object});
  target.triangles.push_back({base, base + 2, base + 3, quad.material, object});
  target.objects.push_back("quad " + std::to_string(object));
}

}  // namespace

scene::Material white_lambertian() {
  scene::Material material;
  material.metallic = 0;
  material.specular_factor = 0;
  material.double_sided = true;
  return material;
}

scene::Camera look_at(const glm::vec3& eye, const glm::vec3& target, float vertical_fov_radians, const glm::vec3& up) {
  scene::Camera camera;
  camera.name = "test";
  camera.world_from_camera = glm::inverse(glm::lookAtRH(eye, target, up));
  camera.vertical_fov = vertical_fov_radians;
  return camera;
}

scene::Scene make_quad_scene(const std::vector<QuadSpec>& quads, std::vector<scene::Material> materials,
                             const scene::Camera& camera) {
  scene::Scene made;
  made.file = "quads";
  if (materials.empty()) materials.push_back(white_lambertian());
  made.materials = std::move(materials);
  made.cameras = {camera};
  made.bounds = {quads.front().corner, quads.front().corner};
  for (const QuadSpec& quad : quads) add_quad(made, quad);
  made.static_vertex_count = static_cast<uint32_t>(made.vertices.size());
  made.static_triangle_count = static_cast<uint32_t>(made.triangles.size());
  made.features.specular = true;
  for (const scene::Material& material : made.materials) {
    made.features.emissive = made.features.emissive || material.emission != glm::vec3(0);
    made.features.metallic = made.features.metallic || material.metallic > 0;
    made.features.anisotropic = made.features.anisotropic || material.anisotropy_strength > 0;
  }
  return made;
}

}  // namespace lightloom::stability
