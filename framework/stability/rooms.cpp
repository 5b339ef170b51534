#include "framework/stability/rooms.hpp"

namespace lightloom::stability {
namespace {

scene::Material colored(const glm::vec3& color) {
  scene::Material material = white_lambertian();
  material.base_color = glm::vec4(color, 1);
  return material;
}

scene::Camera placed(scene::Camera camera, const Placement& placement) {
  glm::mat4& matrix = camera.world_from_camera;
  const glm::vec3 eye = placement.scale * (placement.turn * glm::vec3(matrix[3])) + placement.shift;
  matrix = glm::mat4(placement.turn * glm::mat3(matrix));
  // A mirrored view is no view: the picture is turned over instead, left to right.
  if (glm::determinant(placement.turn) < 0) matrix[0] = -matrix[0];
  matrix[3] = glm::vec4(eye, 1);
  camera.half_height *= placement.scale;
  return camera;
}

void place_vertices(scene::Scene& scene, const Placement& placement) {
  const bool mirrors = glm::determinant(placement.turn) < 0;
  for (scene::Vertex& vertex : scene.vertices) {
    vertex.position = placement.scale * (placement.turn * vertex.position) + placement.shift;
    vertex.normal = placement.turn * vertex.normal;
    vertex.tangent =
        glm::vec4(placement.turn * glm::vec3(vertex.tangent), mirrors ? -vertex.tangent.w : vertex.tangent.w);
  }
  if (!mirrors) return;
  for (scene::Triangle& triangle : scene.triangles) std::swap(triangle.b, triangle.c);
}

}  // namespace

std::vector<QuadSpec> box_walls(const glm::vec3& low, const glm::vec3& high, uint32_t material) {
  const glm::vec3 d = high - low, x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
  return {{low + z, x, -z, material},  {low + y, x, z, material},  {low, x, y, material},
          {high - y, -x, y, material}, {low + z, -z, y, material}, {low + x, z, y, material}};
}

scene::Scene furnished_room() {
  std::vector<scene::Material> materials = {colored({0.7f, 0.7f, 0.7f}), colored({0.6f, 0.1f, 0.1f}),
                                            colored({0.1f, 0.5f, 0.1f}), colored({0, 0, 0}),
                                            colored({0.8f, 0.8f, 0.3f}), colored({0.3f, 0.4f, 0.8f})};
  materials[3].emission = glm::vec3(8, 7, 5);
  materials[5].specular_factor = 1;
  materials[5].roughness = 0.4f;
  std::vector<QuadSpec> quads = box_walls(glm::vec3(-2), glm::vec3(2));
  quads[4].material = 1;
  quads[5].material = 2;
  quads[0].material = 5;
  quads.push_back({{-0.5f, 1.75f, -0.5f}, {1, 0, 0}, {0, 0, 1}, 3});
  quads.push_back({{-1.25f, -1.75f, -0.75f}, {1.5f, 0.5f, 0.25f}, {-0.25f, 1.5f, 0.5f}, 4});
  return make_quad_scene(quads, materials, look_at({0.25f, -0.125f, 1.75f}, {0, -0.25f, -1}, 1.2f));
}

scene::Scene placed(const scene::Scene& scene, const Placement& placement) {
  scene::Scene result = scene;
  place_vertices(result, placement);
  for (scene::Camera& camera : result.cameras) camera = placed(camera, placement);
  const glm::vec3 a = placement.scale * (placement.turn * scene.bounds.min) + placement.shift;
  const glm::vec3 b = placement.scale * (placement.turn * scene.bounds.max) + placement.shift;
  result.bounds = {glm::min(a, b), glm::max(a, b)};
  if (result.sun) result.sun->direction = placement.turn * result.sun->direction;
  for (scene::PunctualLight& light : result.punctual) {
    light.position = placement.scale * (placement.turn * light.position) + placement.shift;
    light.direction = placement.turn * light.direction;
    light.range *= placement.scale;
    if (light.type != scene::PunctualType::directional) light.intensity *= placement.scale * placement.scale;
  }
  return result;
}

RunOptions small_run(uint32_t width, uint32_t height, uint32_t resolution) {
  RunOptions options;
  options.link.view = options.link.trace = {width, height};
  options.link.sets = {{"resolution", std::to_string(resolution)}};
  options.link.variants = {"raw"};
  return options;
}

std::string small_graph(uint32_t width, uint32_t height, uint32_t resolution, const std::string& extra,
                        const std::string& outputs) {
  const std::string size = R"({ "width": )" + std::to_string(width) + R"(, "height": )" + std::to_string(height) + " }";
  return R"({ "lightloom": 1, "name": "small", "view": )" + size + R"(, "trace": )" + size + R"(, "passes": {
    "voxelize": { "type": "voxelize", "params": { "resolution": )" +
         std::to_string(resolution) + R"( } },
    "distance": { "type": "distance_transform", "in": { "voxels": "voxelize.voxels" } },
    "gather": { "type": "gather" })" +
         extra + R"( }, "outputs": { )" + outputs + " } }";
}

}  // namespace lightloom::stability
