#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "framework/stability/check.hpp"
#include "framework/stability/light_lab.hpp"
#include "framework/stability/statistics.hpp"

namespace lightloom::stability {
namespace {

constexpr double kPi = std::numbers::pi;

/// Like the room's lamp.
void add_emitter(scene::Scene& scene, const scene::Material& material, const std::array<glm::vec3, 3>& corners) {
  const auto index = static_cast<uint32_t>(scene.materials.size());
  scene.materials.push_back(material);
  const auto base = static_cast<uint32_t>(scene.vertices.size());
  for (const glm::vec3& corner : corners) {
    scene::Vertex vertex;
    vertex.position = corner;
    scene.vertices.push_back(vertex);
  }
  scene.triangles.push_back({base, base + 1, base + 2, index, static_cast<uint32_t>(scene.objects.size())});
  scene.objects.push_back("added");
  scene.static_vertex_count = static_cast<uint32_t>(scene.vertices.size());
  scene.static_triangle_count = static_cast<uint32_t>(scene.triangles.size());
}

/// Rendered by each graph that ships: texels that differ from the room without what was added.
void add_comparison(Lab& lab, const scene::Scene& base, const scene::Scene& changed, const std::string& what,
                    std::vector<Figure>& figures) {
  for (const char* graph : {"lightloom", "paper"})
    figures.push_back(
        none(std::string(graph) + ", texels that change by " + what,
             differing_texels(render_shipped(lab, graph, base, 2), render_shipped(lab, graph, changed, 2))));
}

std::vector<Figure> measure_nothing_added(Lab& lab) {
  std::vector<Figure> figures;
  const scene::Scene room = lamp_room();
  scene::Material lamp = room.materials[1];
  // Of no area, where the lamp's own triangles already are: what is emissive is looked for by voxels, too.
  const glm::vec3 on_lamp(0.1f, 1.9f, 0.1f);
  scene::Scene point = room, line = room, black = room, unseen = room;
  add_emitter(point, lamp, {on_lamp, on_lamp, on_lamp});
  add_comparison(lab, room, point, "an emitter that is a point", figures);
  add_emitter(line, lamp, {on_lamp, on_lamp + glm::vec3(0.5f, 0, 0), on_lamp + glm::vec3(0.25f, 0, 0)});
  add_comparison(lab, room, line, "an emitter that is a line", figures);
  // What hides nothing: under the floor, facing away.
  const std::array<glm::vec3, 3> below{glm::vec3(0, 0, 0), glm::vec3(0.3f, 0, 0), glm::vec3(0, 0, 0.3f)};
  scene::Material dark = white_lambertian();
  add_emitter(unseen, dark, below);
  dark.emission = glm::vec3(0);
  add_emitter(black, dark, below);
  add_comparison(lab, unseen, black, "an emitter of radiance 0 in place of what does not emit", figures);
  return figures;
}

std::vector<Figure> measure_no_power(Lab& lab) {
  scene::Scene dark = lamp_room();
  scene::Scene black_image = dark;
  dark.materials[1].emission = glm::vec3(0);
  dark.features.emissive = false;
  // Emits by its factor, but its image is black: nothing is left to draw from.
  black_image.images.push_back({"black", 2, 2, std::vector<uint8_t>(16, 0), true});
  black_image.materials[1].emissive_texture.image = 0;
  black_image.features.textured = true;
  scene::Scene flat = lamp_room();
  for (uint32_t corner = 8; corner < 12; ++corner) flat.vertices[corner].position = glm::vec3(0, 1.9f, 0);
  std::vector<Figure> figures;
  for (const char* graph : {"lightloom", "paper"}) {
    const image::HostImage nothing = render_shipped(lab, graph, dark, 2);
    const image::HostImage image = render_shipped(lab, graph, black_image, 2);
    const image::HostImage point = render_shipped(lab, graph, flat, 2);
    figures.push_back(at_most(std::string(graph) + ", light of a room without a light", mean_channel(nothing, 0), 0));
    figures.push_back(at_most(std::string(graph) + ", light of a lamp with a black image", mean_channel(image, 0), 0));
    figures.push_back(
        none(std::string(graph) + ", values that are not finite where all emitters have no area", non_finite(point)));
  }
  return figures;
}

/// From one square to an equal one opposite, one edge away.
double opposite_squares() {
  const double root = std::sqrt(2.0);
  return 2 / kPi * (std::log(std::sqrt(4.0 / 3)) + 2 * root * std::atan(1 / root) - 2 * std::atan(1.0));
}

/// A floor of albedo 0.5, of which the unit square in the middle fills the image, and a unit square of light over it.
scene::Scene under_lamp(float radiance) {
  scene::Material floor = white_lambertian(), lamp = white_lambertian();
  floor.base_color = glm::vec4(0.5f, 0.5f, 0.5f, 1);
  floor.double_sided = lamp.double_sided = false;
  lamp.base_color = glm::vec4(0, 0, 0, 1);
  lamp.emission = glm::vec3(radiance);
  return make_quad_scene({{{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 0}, {{-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1}, 1}},
                         {floor, lamp}, look_at({0, 0.5f, 0}, {0, 0, 0}, static_cast<float>(kPi / 2), {0, 0, -1}));
}

std::vector<Figure> measure_bright(Lab& lab) {
  constexpr float kRadiance = 1e8f;
  SampleMean light;
  double bad = 0;
  for (const Images& images :
       trace(lab, under_lamp(kRadiance),
             {.params = R"("paths": 16, "bounces": 0, "strategy": "nee")", .resolution = 66, .frames = 12})) {
    light.add(mean_channel(images.at("radiance"), 0));
    bad += non_finite(images.at("radiance"));
  }
  const double exact = static_cast<double>(kRadiance) * opposite_squares();
  scene::Scene room = lamp_room();
  room.materials[1].emission = glm::vec3(kRadiance);
  double brightest = 0;
  for (const char* graph : {"lightloom", "paper", "reference"}) {
    const image::HostImage image = render_shipped(lab, graph, room, 3);
    bad += non_finite(image);
    double largest = 0;
    for (uint32_t y = 0; y < image.desc.extent.height; ++y)
      for (uint32_t x = 0; x < image.desc.extent.width; ++x) largest = std::max(largest, image.at(x, y, 0, 0));
    brightest = std::max(brightest, std::abs(largest / static_cast<double>(kRadiance) - 1));
  }
  return {at_most("light of a square opposite an equal one, off pi L F", std::abs(light.mean() - exact) / light.error(),
                  3, "standard errors"),
          at_most("standard error of that", light.error() / exact, 5e-3, "relative"),
          none("values that are not finite, also in graphs that ship", bad),
          // Light that the lamp reflects itself comes on top.
          at_most("the lamp as it is seen, off its radiance", brightest, 0.25, "relative")};
}

std::vector<Figure> measure_scale(Lab& lab) {
  std::vector<Figure> figures;
  const scene::Scene room = room_of_all_lights();
  for (const char* graph : {"lightloom", "paper", "reference"}) {
    const image::HostImage base = render_shipped(lab, graph, room, 4);
    for (const double factor : {0x1p27, 0x1p-27, 1e8, 1e-8}) {
      scene::Scene scaled = room;
      scale_light(scaled, static_cast<float>(factor));
      const bool power_of_two = factor == 0x1p27 || factor == 0x1p-27;
      const std::string name = factor == 0x1p27 ? "2^27" : factor == 0x1p-27 ? "2^-27" : factor > 1 ? "1e8" : "1e-8";
      figures.push_back(at_most(std::string(graph) + ", all light times " + name,
                                difference_to_scaled(render_shipped(lab, graph, scaled, 4), base, factor),
                                power_of_two ? 0 : 1e-5, "of the brightest"));
    }
  }
  return figures;
}

/// One quad as n by n of the same material and object.
scene::Scene split_lamp(uint32_t n) {
  const scene::Scene whole = lamp_room();
  std::vector<QuadSpec> quads = {{{-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 0},
                                 {{-2, 0, -2}, {4, 0, 0}, {0, 2.5f, 0}, 0},
                                 {{0.2f, 0, 0.3f}, {0.6f, 0, 0.2f}, {0, 0.9f, 0}, 2}};
  for (uint32_t i = 0; i < n * n; ++i)
    quads.push_back({{-0.8f + 1.6f * static_cast<float>(i % n) / static_cast<float>(n), 1.9f,
                      -0.7f + 1.4f * static_cast<float>(i / n) / static_cast<float>(n)},
                     {1.6f / static_cast<float>(n), 0, 0},
                     {0, 0, 1.4f / static_cast<float>(n)},
                     1});
  scene::Scene made = make_quad_scene(quads, whole.materials, whole.cameras.front());
  made.bounds = whole.bounds;
  return made;
}

/// Pixels of the same position to the last bit, which the interpolation within other triangles changes, that differ.
double differing_where_same(const image::HostImage& a, const image::HostImage& b, const image::HostImage& position_a,
                            const image::HostImage& position_b) {
  double count = 0;
  for (uint32_t y = 0; y < a.desc.extent.height; ++y)
    for (uint32_t x = 0; x < a.desc.extent.width; ++x) {
      bool same_place = true, same_light = true;
      for (uint32_t channel = 0; channel < 3; ++channel) {
        same_place = same_place && position_a.at(x, y, 0, channel) == position_b.at(x, y, 0, channel);
        same_light = same_light && a.at(x, y, 0, channel) == b.at(x, y, 0, channel);
      }
      if (same_place && !same_light) ++count;
    }
  return count;
}

std::vector<Figure> measure_split(Lab& lab) {
  std::vector<Figure> figures;
  for (const bool faces : {true, false}) {
    const TraceOptions options{.faces = faces, .frames = 12};
    const std::vector<Images> whole = trace(lab, split_lamp(1), options), parts = trace(lab, split_lamp(4), options);
    SampleMean difference;
    double texels = 0;
    for (size_t frame = 0; frame < whole.size(); ++frame) {
      const image::HostImage &a = whole[frame].at("radiance"), &b = parts[frame].at("radiance");
      difference.add(mean_channel(a, 1) - mean_channel(b, 1));
      texels += differing_where_same(a, b, whole[frame].at("position"), parts[frame].at("position"));
    }
    if (faces)
      figures.push_back(none("by faces of voxels, pixels that differ where they see the same point", texels));
    else
      figures.push_back(at_most("by hints, difference of the means", std::abs(difference.mean()) / difference.error(),
                                3, "standard errors"));
  }
  return figures;
}

}  // namespace

void add_light_checks(std::vector<Check>& checks) {
  const CheckGroup add(checks, "emitters");
  add("nothing_added", "an emitter without area, and one without radiance, beside a lamp",
      "0/0 in the table of emitters, other random choices",
      "emitters are drawn by area times luminance: framework/scene/lights.cpp", measure_nothing_added);
  add("no_power", "no emitter at all, one with a black image, none with an area", "division by a total of 0",
      "no hints and no faces where the total is 0: framework/scene/lights.cpp, shaders/lib/emitters.glsl",
      measure_no_power);
  add("bright_emitter", "radiance 1e8", "half floats end at 65504, squares in them at 256",
      "emission in 32 bits: passes/bundles.hpp; light up to 1e18: shaders/lib/traced_light.glsl", measure_bright);
  add("radiance_scale", "all light times 1e-8 and 1e8, 2^-27 and 2^27, in whole graphs",
      "limits and unknown variances in absolute units",
      "kUnknownVariance above all light: shaders/lib/variance.glsl; relative tests: shaders/lib/neighbour.glsl",
      measure_scale);
  add("split_emitters", "a lamp of one quad against 16", "power by triangles instead of area",
      "weights by area and by voxel faces: framework/scene/lights.cpp", measure_split);
}

}  // namespace lightloom::stability
