#include "framework/stability/light_lab.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lightloom::stability {
namespace {

constexpr uint32_t kWidth = 48, kHeight = 36;

scene::Material glossy() {
  scene::Material material;
  material.base_color = glm::vec4(0.6f, 0.5f, 0.4f, 1);
  material.metallic = 0;
  material.roughness = 0.6f;
  material.double_sided = true;
  return material;
}

template <typename Visit>
void for_each_texel(const image::HostImage& image, const Visit& visit) {
  const Extent3 extent = image.desc.extent;
  for (uint32_t y = 0; y < extent.height; ++y)
    for (uint32_t x = 0; x < extent.width; ++x) visit(x, y);
}

}  // namespace

scene::Scene lamp_room() {
  scene::Material lamp = white_lambertian();
  lamp.base_color = glm::vec4(0.2f, 0.2f, 0.2f, 1);
  lamp.emission = glm::vec3(1, 0.8f, 0.5f);
  scene::Material post = glossy();
  post.metallic = 1;
  post.roughness = 0.4f;
  return make_quad_scene({{{-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 0},
                          {{-2, 0, -2}, {4, 0, 0}, {0, 2.5f, 0}, 0},
                          {{-0.8f, 1.9f, -0.7f}, {1.6f, 0, 0}, {0, 0, 1.4f}, 1},
                          {{0.2f, 0, 0.3f}, {0.6f, 0, 0.2f}, {0, 0.9f, 0}, 2}},
                         {glossy(), lamp, post}, look_at({-1.2f, 1.6f, 3.4f}, {0, 0.6f, 0}, 0.9f));
}

scene::Scene room_of_all_lights() {
  scene::Scene scene = lamp_room();
  scene.sun = scene::Sun{glm::normalize(glm::vec3(0.4f, -1, -0.3f)), glm::vec3(2, 1.8f, 1.5f), 0.05f};
  scene.environment = {glm::vec3(1), 8, 4, {}};
  for (int texel = 0; texel < 32; ++texel)
    for (int channel = 0; channel < 3; ++channel)
      scene.environment.rgb.push_back(0.1f + 0.05f * static_cast<float>((texel * 7 + channel) % 11));
  scene::PunctualLight light;
  light.intensity = glm::vec3(0.7f, 0.9f, 1);
  light.position = glm::vec3(-1.3f, 1.1f, 0.5f);
  scene.punctual.push_back(light);
  scene.features.sun = scene.features.environment = scene.features.environment_image = scene.features.punctual = true;
  return scene;
}

void scale_light(scene::Scene& scene, float factor) {
  for (scene::Material& material : scene.materials) material.emission *= factor;
  if (scene.sun) scene.sun->irradiance *= factor;
  scene.environment.radiance *= factor;
  for (scene::PunctualLight& light : scene.punctual) light.intensity *= factor;
}

image::HostImage render_shipped(Lab& lab, const std::string& graph, const scene::Scene& scene, uint32_t frames,
                                uint32_t seed) {
  RunOptions options;
  options.frames = frames;
  options.seed = seed;
  options.link.view = {kWidth, kHeight};
  options.link.trace = {kWidth, kHeight};
  options.link.sets = {{"resolution", "32"}};
  if (graph == "reference") options.link.sets.emplace_back("paths", "2");
  return lab.last_frame(lab.shipped_graph(graph), scene, options).at("radiance");
}

std::vector<Images> trace(Lab& lab, const scene::Scene& scene, const TraceOptions& options) {
  const std::string size = std::to_string(options.size);
  const std::string faces = options.faces ? R"(
    "faces": { "type": "emissive_faces", "in": { "voxels": "voxelize.voxels" } },)"
                                          : "";
  const std::string inputs = options.faces ? R"(, "faces": "faces.faces", "power": "faces.power")" : "";
  const std::string nee = options.faces ? R"(, "nee": "voxel_faces", "emitter_area": "surface")" : "";
  const std::string text = R"({ "lightloom": 1, "name": "trace", "view": { "width": )" + size + R"(, "height": )" +
                           size + R"( }, "trace": { "width": )" + size + R"(, "height": )" + size + R"( }, "passes": {
    "voxelize": { "type": "voxelize", "params": { "geometry": "all", "resolution": )" +
                           std::to_string(options.resolution) + R"( } },
    "distance": { "type": "distance_transform", "in": { "voxels": "voxelize.voxels" } },)" +
                           faces + R"(
    "gather": { "type": "gather" },
    "trace": { "type": "voxel_path_trace", "in": { "surface": "gather.surface", "voxels": "voxelize.voxels",
               "distance": "distance.distance")" +
                           inputs + R"( }, "params": { )" + options.params + nee + R"( } } },
    "outputs": { "radiance": "trace.radiance", "position": "gather.surface.position" } })";
  RunOptions run;
  run.frames = options.frames;
  run.seed = options.seed;
  return lab.frames(text, scene, run);
}

double non_finite(const image::HostImage& image) {
  double count = 0;
  for_each_texel(image, [&](uint32_t x, uint32_t y) {
    for (uint32_t channel = 0; channel < 3; ++channel)
      if (!std::isfinite(image.at(x, y, 0, channel))) ++count;
  });
  return count;
}

double mean_channel(const image::HostImage& image, uint32_t channel) {
  double sum = 0, count = 0;
  for_each_texel(image, [&](uint32_t x, uint32_t y) {
    if (!(image.at(x, y, 0, 3) > 0)) return;
    sum += image.at(x, y, 0, channel);
    ++count;
  });
  return sum / count;
}

double difference_to_scaled(const image::HostImage& a, const image::HostImage& b, double factor) {
  double difference = 0, largest = 0;
  for_each_texel(b, [&](uint32_t x, uint32_t y) {
    for (uint32_t channel = 0; channel < 3; ++channel) {
      const double expected = factor * b.at(x, y, 0, channel);
      const double off = std::abs(a.at(x, y, 0, channel) - expected);
      difference = std::isfinite(off) ? std::max(difference, off) : std::numeric_limits<double>::infinity();
      largest = std::max(largest, expected);
    }
  });
  return difference / largest;
}

}  // namespace lightloom::stability
