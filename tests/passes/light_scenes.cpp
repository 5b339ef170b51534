#include "tests/passes/light_scenes.hpp"

namespace lightloom::test {

std::vector<Images> trace_frames(const scene::Scene& scene, const TraceSettings& settings) {
  const uint32_t size = settings.size;
  const std::string text = graph_text(size, size, size, size, trace_passes(settings.resolution, settings.params),
                                      R"("radiance": "trace.radiance", "position": "gather.surface.position",
                                         "material": "gather.surface.material")");
  GraphRunOptions options;
  options.frames = settings.frames;
  options.seed = settings.seed;
  return run_graph(text, scene, options);
}

std::vector<SampleMean> block_estimates(const std::vector<Images>& frames, uint32_t channel, uint32_t block) {
  const Extent3 extent = frames.front().at("radiance").desc.extent;
  const uint32_t across = extent.width / block, down = extent.height / block;
  std::vector<SampleMean> blocks(size_t{across} * down);
  for (const Images& images : frames)
    for (uint32_t y = 0; y < down; ++y)
      for (uint32_t x = 0; x < across; ++x)
        blocks[size_t{y} * across + x].add(
            mean_of(images.at("radiance"), channel, x * block, y * block, (x + 1) * block, (y + 1) * block));
  return blocks;
}

SampleMean frame_estimate(const std::vector<Images>& frames, uint32_t channel) {
  const Extent3 extent = frames.front().at("radiance").desc.extent;
  SampleMean estimate;
  for (const Images& images : frames)
    estimate.add(mean_of(images.at("radiance"), channel, 0, 0, extent.width, extent.height));
  return estimate;
}

void add_pixels(SampleMean& estimate, const Images& images, uint32_t channel, uint32_t x0, uint32_t x1) {
  const image::HostImage& radiance = images.at("radiance");
  for (uint32_t y = 0; y < radiance.desc.extent.height; ++y)
    for (uint32_t x = x0; x < x1; ++x)
      if (radiance.at(x, y, 0, 3) > 0) estimate.add(radiance.at(x, y, 0, channel));
}

scene::Camera orthographic(const glm::vec3& eye, const glm::vec3& target, float half_height, const glm::vec3& up) {
  scene::Camera camera = look_at(eye, target, 1, up);
  camera.perspective = false;
  camera.half_height = half_height;
  return camera;
}

glm::dvec3 surface_position(const Images& images, uint32_t x, uint32_t y) {
  const image::HostImage& position = images.at("position");
  return {position.at(x, y, 0, 0), position.at(x, y, 0, 1), position.at(x, y, 0, 2)};
}

QuadSpec square_floor(float half_width, uint32_t material) {
  return {{-half_width, 0, half_width}, {2 * half_width, 0, 0}, {0, 0, -2 * half_width}, material};
}

scene::Material glossy_floor() {
  scene::Material material;
  material.base_color = glm::vec4(0.6f, 0.5f, 0.4f, 1);
  material.metallic = 0;
  material.roughness = 0.6f;
  material.anisotropy_strength = 0.4f;
  return material;
}

scene::Scene lamps_scene(const scene::Material& along, const scene::Material& across) {
  const std::vector<QuadSpec> quads = {{{-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 0},
                                       {{-2, 0, -2}, {4, 0, 0}, {0, 2.5f, 0}, 0},
                                       {{-1.5f, 1.8f, -0.7f}, {1.2f, 0, 0}, {0, 0, 1.4f}, 1},
                                       {{0.4f, 1.0f, -0.4f}, {0.9f, 0.5f, 0}, {-0.2f, 0.3f, 1.1f}, 2},
                                       {{0, 0, 0.3f}, {0.4f, 0, 0.2f}, {0, 0.7f, 0}, 0}};
  return make_quad_scene(quads, {glossy_floor(), along, across}, look_at({-1.2f, 1.6f, 2.6f}, {0, 0.3f, 0}, 0.9f));
}

std::vector<QuadSpec> room_walls(const glm::vec3& low, const glm::vec3& high, uint32_t material) {
  const glm::vec3 d = high - low, x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
  return {{low + z, x, -z, material},  {low + y, x, z, material},  {low, x, y, material},
          {high - y, -x, y, material}, {low + z, -z, y, material}, {low + x, z, y, material}};
}

scene::Scene two_rooms(const glm::mat3& turn, Partition partition) {
  scene::Material wall = lambertian(glm::vec3(0.8f));
  scene::Material lamp = lambertian(glm::vec3(0));
  lamp.emission = glm::vec3(1e4f);
  lamp.double_sided = true;
  wall.double_sided = true;
  std::vector<QuadSpec> quads = room_walls({-1, -1, -1}, {1, 1, 1}, 0);
  if (partition == Partition::faces_away) quads.push_back({{0.07f, -1, 1}, {0, 0, -2}, {0, 2, 0}, 0});
  if (partition == Partition::faces_lamp) quads.push_back({{0.07f, -1, -1}, {0, 0, 2}, {0, 2, 0}, 0});
  quads.push_back({{-0.9f, 0.3f, -0.6f}, {0.8f, 0, 0}, {0, 0, 1.2f}, 1});
  for (QuadSpec& quad : quads) quad = {turn * quad.corner, turn * quad.edge_u, turn * quad.edge_v, quad.material};
  scene::Scene scene = make_quad_scene(quads, {wall, lamp},
                                       look_at(turn * glm::vec3(0.95f, 0, 0), turn * glm::vec3(0, 0.1f, 0.05f), 2.4f));
  scene::PunctualLight bulb;
  bulb.intensity = glm::vec3(1e4f);
  bulb.position = turn * glm::vec3(-0.5f, -0.4f, 0.2f);
  scene.punctual = {bulb};
  scene.features.punctual = true;
  return scene;
}

glm::mat3 turned(float around_y, float around_x) {
  return glm::mat3(glm::rotate(glm::rotate(glm::mat4(1), around_y, glm::vec3(0, 1, 0)), around_x, glm::vec3(1, 0, 0)));
}

}  // namespace lightloom::test
