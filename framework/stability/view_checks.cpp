#include <algorithm>
#include <cmath>
#include <string>

#include "framework/stability/check.hpp"
#include "framework/stability/differences.hpp"
#include "framework/stability/rooms.hpp"

namespace lightloom::stability {
namespace {

constexpr float kFov = 0.9f;

/// A wall that fills a view of this aspect, and not much more, as floats resolve less of a larger one; seen straight on
/// from 2 m away; white, lit by a sky.
scene::Scene wall_scene(float aspect) {
  const float half = std::max(4.0f, 2 * aspect);
  scene::Scene scene =
      make_quad_scene({{{-half, -4, 0}, {2 * half, 0, 0}, {0, 8, 0}}}, {}, look_at({0, 0, 2}, {0, 0, 0}, kFov));
  scene.environment.radiance = glm::vec3(1);
  scene.features.environment = true;
  return scene;
}

/// Largest distance between where the wall is in a pixel and where a pinhole camera sees it, over the pixel's size.
double position_error(const image::HostImage& positions) {
  const Extent3& extent = positions.desc.extent;
  const double half = 2 * std::tan(static_cast<double>(kFov) / 2);  // of the wall, as high as is seen
  const double pixel = 2 * half / extent.height;
  double error = 0;
  for (uint32_t y = 0; y < extent.height; ++y)
    for (uint32_t x = 0; x < extent.width; ++x) {
      const glm::dvec3 expected((x + 0.5 - 0.5 * extent.width) * pixel, (0.5 * extent.height - y - 0.5) * pixel, 0);
      const glm::dvec3 found(positions.at(x, y, 0, 0), positions.at(x, y, 0, 1), positions.at(x, y, 0, 2));
      const double off = glm::length(found - expected) / pixel;
      error = std::isfinite(off) ? std::max(error, off) : INFINITY;
    }
  return error;
}

double unwritten(const image::HostImage& picture) {
  const Extent3& extent = picture.desc.extent;
  double count = 0;
  for (uint32_t y = 0; y < extent.height; ++y)
    for (uint32_t x = 0; x < extent.width; ++x) count += picture.at(x, y, 0, 3) == 1 ? 0 : 1;
  return count;
}

std::vector<Figure> measure_sizes(Lab& lab, const std::vector<std::pair<uint32_t, uint32_t>>& sizes) {
  const std::string graph = lab.shipped_graph("lightloom");
  std::vector<Figure> figures;
  for (const auto& [width, height] : sizes) {
    const scene::Scene wall = wall_scene(static_cast<float>(width) / static_cast<float>(height));
    RunOptions options = small_run(width, height, 8);
    options.link.variants.clear();
    options.frames = 2;
    options.capture = {"gather.surface.position"};
    const Images images = lab.last_frame(graph, wall, options);
    const std::string at = ", " + std::to_string(width) + "x" + std::to_string(height);
    figures.push_back(
        at_most("largest error of places" + at, position_error(images.at("gather.surface.position")), 1e-2, "pixels"));
    figures.push_back(none("pixels not written" + at, unwritten(images.at("radiance"))));
    figures.push_back(none("pixels that are not finite" + at,
                           non_finite_texels(images.at("radiance")) + non_finite_texels(images.at("image"))));
  }
  return figures;
}

constexpr uint32_t kWidth = 32, kHeight = 24;

/// Texels whose radiance is not exactly `value`.
double other_than(const image::HostImage& picture, const glm::dvec3& value) {
  double count = 0;
  for (uint32_t y = 0; y < picture.desc.extent.height; ++y)
    for (uint32_t x = 0; x < picture.desc.extent.width; ++x)
      count +=
          picture.at(x, y, 0, 0) == value.x && picture.at(x, y, 0, 1) == value.y && picture.at(x, y, 0, 2) == value.z
              ? 0
              : 1;
  return count;
}

scene::Scene with_sky(scene::Scene scene, const glm::vec3& radiance) {
  scene.environment.radiance = radiance;
  scene.features.environment = radiance != glm::vec3(0);
  return scene;
}

Images shown(Lab& lab, const scene::Scene& scene, const char* graph = "lightloom") {
  RunOptions options = small_run(kWidth, kHeight, 32);
  options.link.variants.clear();
  if (std::string_view(graph) == "reference") options.link.sets = {{"paths", "2"}};
  options.frames = 2;
  return lab.last_frame(lab.shipped_graph(graph), scene, options);
}

constexpr glm::vec3 kSky(0.25f, 0.5f, 2);

std::vector<Figure> measure_cameras(Lab& lab) {
  struct Place {
    std::string name;
    scene::Camera camera;
    bool sees_sky;
  };
  const std::vector<Place> places = {
      {"within a wall", look_at({-2, 0.1f, 0}, {2, 0, 0.3f}, 1.2f), false},
      {"on a corner of the room", look_at({2, 2, 2}, {0, 0, 0}, 1.2f), false},
      {"within a slanting board", look_at({-0.625f, -0.75f, -0.375f}, {1, 0, 0.3f}, 1.2f), false},
      {"outside, behind walls", look_at({0, 0, 40}, {0, 0, 0}, 0.4f), false},
      {"1e4 m away", look_at({0, 1e4f, 0}, {0, 0, 0}, 1e-3f, {0, 0, 1}), false},
      {"outside, looking away", look_at({0, 0, 40}, {0, 0, 80}, 0.8f), true},
      {"1e6 m away, looking away", look_at({1e6f, 0, 0}, {2e6f, 0, 0}, 0.8f), true},
  };
  std::vector<Figure> figures;
  for (const Place& place : places) {
    scene::Scene room = with_sky(furnished_room(), kSky);
    room.cameras = {place.camera};
    for (const char* graph : {"lightloom", "paper", "reference"}) {
      const image::HostImage picture = shown(lab, room, graph).at("radiance");
      const std::string at = ", " + place.name + ", " + graph;
      figures.push_back(none("pixels that are not finite" + at, non_finite_texels(picture)));
      if (place.sees_sky) figures.push_back(none("pixels other than the sky" + at, other_than(picture, kSky)));
    }
  }
  return figures;
}

std::vector<Figure> measure_nothing(Lab& lab) {
  scene::Scene dark = furnished_room();
  dark.materials[3].emission = glm::vec3(0);
  dark.features.emissive = false;
  scene::Scene black = furnished_room();
  for (scene::Material& material : black.materials) {
    material.base_color = glm::vec4(0, 0, 0, 1);
    material.specular_factor = 0;
    material.emission = glm::vec3(0);
  }
  black.features.emissive = false;
  scene::Scene empty = with_sky(furnished_room(), kSky);
  empty.vertices.clear();
  empty.triangles.clear();
  empty.static_vertex_count = empty.static_triangle_count = 0;
  empty.features.emissive = empty.features.specular = false;
  scene::Scene pointless = empty;
  pointless.bounds = {};
  std::vector<Figure> figures;
  for (const char* graph : {"lightloom", "paper", "reference"}) {
    const std::string by = std::string(", ") + graph;
    figures.push_back(
        none("pixels that are not black without light" + by, other_than(shown(lab, dark, graph).at("radiance"), {})));
    figures.push_back(none("pixels that are not black, all surfaces black" + by,
                           other_than(shown(lab, black, graph).at("radiance"), {})));
    figures.push_back(none("pixels other than the sky, no triangles" + by,
                           other_than(shown(lab, empty, graph).at("radiance"), kSky)));
    figures.push_back(none("pixels other than the sky, no triangles and no bounds" + by,
                           other_than(shown(lab, pointless, graph).at("radiance"), kSky)));
  }
  return figures;
}

}  // namespace

void add_view_checks(std::vector<Check>& checks) {
  const char* danger = "pixels that no thread writes, divisions by a width less one, ratios that overflow";
  const char* guard = "group counts are rounded up and threads beyond the image leave: every shader's first line";
  checks.push_back({.name = "view_sizes",
                    .group = "views",
                    .extreme = "views of 1x1, 1x33, 33x1, 3x5, 61x47 and 4096x2 pixels",
                    .danger = danger,
                    .guard = guard,
                    .measure = [](Lab& lab) {
                      return measure_sizes(lab, {{1, 1}, {1, 33}, {33, 1}, {3, 5}, {61, 47}, {4096, 2}});
                    }});
  checks.push_back({.name = "view_641x479",
                    .group = "views",
                    .extreme = "a view of 641x479 pixels, both prime to the size of a group",
                    .danger = danger,
                    .guard = guard,
                    .measure =
                        [](Lab& lab) {
                          return measure_sizes(lab, {{641, 479}});
                        },
                    .slow = true});
  checks.push_back({.name = "camera_places",
                    .group = "views",
                    .extreme = "cameras within walls, outside the grid, far away, looking away",
                    .danger = "marches without end, a view without depth",
                    .guard = "marches end after as many steps as the grid has voxels along its sides: "
                             "shaders/lib/march.glsl",
                    .measure = measure_cameras});
  checks.push_back({.name = "nothing_to_see",
                    .group = "views",
                    .extreme = "no triangles, no light, all surfaces black",
                    .danger = "0 / 0 where light is shared out, bounds of nothing",
                    .guard = "sums of power are looked at before they divide: shaders/lib/emissive_faces.glsl, "
                             "framework/scene/lights.cpp",
                    .measure = measure_nothing});
}

}  // namespace lightloom::stability
