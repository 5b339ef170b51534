#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "framework/stability/check.hpp"
#include "framework/stability/differences.hpp"
#include "framework/stability/rooms.hpp"
#include "framework/stability/scene_files.hpp"

namespace lightloom::stability {
namespace {

constexpr double kDegrees = 57.29577951308232;

/// A dark room with walls without thickness, turned so that none of them lies along the grid; around it, in the open,
/// much light: a sky and a lamp on each side.
scene::Scene dark_box() {
  scene::Material wall = white_lambertian();
  scene::Material lamp = white_lambertian();
  lamp.emission = glm::vec3(1e6f);
  const glm::mat4 around_y = glm::rotate(glm::mat4(1), 0.5f, glm::vec3(0, 1, 0));
  const glm::mat3 turn(glm::rotate(around_y, 0.35f, glm::vec3(0.6f, 0.1f, 0.8f)));
  std::vector<QuadSpec> quads = box_walls(glm::vec3(-1), glm::vec3(1));
  for (QuadSpec& quad : quads) quad = {turn * quad.corner, turn * quad.edge_u, turn * quad.edge_v, 0};
  for (const float side : {-1.0f, 1.0f}) {
    quads.push_back({{side * 1.9f, -1, -1}, {0, 2, 0}, {0, 0, 2}, 1});
    quads.push_back({{-1, side * 1.9f, -1}, {0, 0, 2}, {2, 0, 0}, 1});
  }
  scene::Scene scene =
      make_quad_scene(quads, {wall, lamp}, look_at(glm::vec3(0), turn * glm::vec3(0.4f, -0.3f, 1), 2.4f));
  scene.environment.radiance = glm::vec3(1e4f);
  scene.features.environment = true;
  return scene;
}

std::string leak_graph(const std::string& coverage, const std::string& march, const std::string& nee) {
  std::string graph = small_graph(64, 64, 32,
                                  R"(, "faces": { "type": "emissive_faces", "in": { "voxels": "voxelize.voxels" } },
    "trace": { "type": "voxel_path_trace", "in": { "surface": "gather.surface", "voxels": "voxelize.voxels",
        "distance": "distance.distance", "faces": "faces.faces" },
      "params": { "paths": 8, "bounces": 3, "march": ")" +
                                      march + R"(", "nee": ")" + nee + R"(" } })",
                                  R"("light": "trace.radiance")");
  const std::string place = R"("resolution": 32)";
  graph.replace(graph.find(place), place.size(), place + R"(, "coverage": ")" + coverage + "\"");
  return graph;
}

/// Share of the pixels of the dark room that light reaches.
double lit_share(const image::HostImage& light) {
  double lit = 0;
  const Extent3& extent = light.desc.extent;
  for (uint32_t y = 0; y < extent.height; ++y)
    for (uint32_t x = 0; x < extent.width; ++x) lit += light.at(x, y, 0, 0) != 0 ? 1 : 0;
  return lit / (extent.width * extent.height);
}

/// The same room with one wall away: light must come in, or the check would see nothing.
scene::Scene opened(scene::Scene scene) {
  scene.triangles.erase(scene.triangles.begin(), scene.triangles.begin() + 2);
  scene.static_triangle_count = static_cast<uint32_t>(scene.triangles.size());
  return scene;
}

std::vector<Figure> measure_thin(Lab& lab) {
  const scene::Scene box = dark_box();
  std::vector<Figure> figures;
  for (const char* march : {"cube_exit", "dda"})
    for (const char* nee : {"voxel_faces", "hints"})
      figures.push_back(none(std::string("largest radiance in the dark, supercover, ") + march + ", " + nee,
                             largest_value(lab.last_frame(leak_graph("supercover", march, nee), box).at("light"))));
  figures.push_back(at_least(
      "share of lit pixels with a wall away",
      lit_share(lab.last_frame(leak_graph("supercover", "cube_exit", "voxel_faces"), opened(box)).at("light")), 0.5));
  figures.push_back(at_most("share of lit pixels with the paper's coverage and march (measured, no bound)",
                            lit_share(lab.last_frame(leak_graph("raster", "sphere", "hints"), box).at("light")), 1));
  return figures;
}

std::vector<Figure> measure_directions(Lab& lab) {
  const Images images = lab.last_frame(R"({ "lightloom": 1, "name": "voxel_directions", "passes": {
      "directions": { "type": "compute", "shader": "stability/voxel_directions.comp",
        "out": { "normal": { "format": "rgba32_sfloat", "size": "512x512" },
                 "stored_normal": { "format": "rgba32_sfloat", "size": "512x512" },
                 "tangent": { "format": "rgba32_sfloat", "size": "512x512" },
                 "stored_tangent": { "format": "rgba32_sfloat", "size": "512x512" } } } },
      "outputs": { "normal": "directions.normal", "stored_normal": "directions.stored_normal",
                   "tangent": "directions.tangent", "stored_tangent": "directions.stored_tangent" } })",
                                       furnished_room());
  const auto at = [&](const char* name, uint32_t x, uint32_t y) {
    const image::HostImage& image = images.at(name);
    return glm::dvec3(image.at(x, y, 0, 0), image.at(x, y, 0, 1), image.at(x, y, 0, 2));
  };
  const auto degrees = [](const glm::dvec3& a, const glm::dvec3& b) {
    return kDegrees * std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
  };
  double normal = 0, normals = 0, tangent = 0, tangents = 0, length = 0;
  for (uint32_t y = 0; y < 512; ++y)
    for (uint32_t x = 0; x < 512; ++x) {
      const double off = degrees(at("normal", x, y), at("stored_normal", x, y));
      const double turned = degrees(at("tangent", x, y), at("stored_tangent", x, y));
      normal = std::max(normal, off);
      tangent = std::max(tangent, turned);
      normals += off / (512 * 512);
      tangents += turned / (512 * 512);
      length = std::max(length, std::abs(glm::length(at("stored_normal", x, y)) - 1));
      length = std::max(length, std::abs(glm::length(at("stored_tangent", x, y)) - 1));
    }
  return {at_most("largest error of normals", normal, 0.79, "degrees"),
          at_most("mean error of normals", normals, 0.36, "degrees"),
          at_most("largest error of tangents in the stored plane", tangent, 10.3, "degrees"),
          at_most("mean error of tangents", tangents, 1.3, "degrees"),
          at_most("largest error of their lengths", length, 1e-6)};
}

constexpr uint32_t kSide = 32;

RunOptions furnace_run() {
  RunOptions options = small_run(kSide, kSide, 32);
  options.link.sets.emplace_back("paths", "16");
  options.link.sets.emplace_back("bounces", "6");
  return options;
}

/// White things under a white sky are as bright as the sky, as long as paths are not cut short.
std::vector<Figure> measure_flat(Lab& lab) {
  std::vector<Figure> figures;
  const std::string graph = lab.shipped_graph("lightloom");
  for (const bool single : {false, true}) {
    scene::Scene scene =
        make_quad_scene({{{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}}}, {}, look_at({0.2f, 2, 1}, {0, 0, 0}, 0.8f));
    scene.environment.radiance = glm::vec3(1);
    scene.features.environment = true;
    if (single) scene.triangles.pop_back();
    scene.static_triangle_count = static_cast<uint32_t>(scene.triangles.size());
    const std::filesystem::path file = write_scene(lab.folder(), single ? "single" : "flat", scene);
    scene::Scene loaded = scene::load_scene(file);
    loaded.environment = scene.environment;
    loaded.features.environment = true;
    for (const scene::Scene& shown : {scene, loaded}) {
      const std::string name =
          std::string(single ? ", one triangle" : ", a plane without thickness") + (shown.source ? ", loaded" : "");
      const image::HostImage picture = lab.last_frame(graph, shown, furnace_run()).at("radiance");
      figures.push_back(none("pixels that are not finite" + name, non_finite_texels(picture)));
      figures.push_back(at_most("largest value" + name, largest_value(picture), 1 + 1e-3));
      figures.push_back(at_most("error of the mean" + name, std::abs(mean_of(picture).value - 1), 1e-2, "relative"));
    }
  }
  return figures;
}

std::vector<Figure> measure_outlier(Lab& lab) {
  scene::Scene room = furnished_room();
  const std::vector<glm::vec3> far = {{1e3f, 0, 0}, {1e3f, 1, 0}, {1e3f, 0, 1}};
  const auto warnings = [&](const std::filesystem::path& file) {
    double count = 0;
    for (const std::string& warning : scene::load_scene(file).warnings)
      count += warning.find("voxel grid") != std::string::npos ? 1 : 0;
    return count;
  };
  const std::filesystem::path file = write_scene(lab.folder(), "outlier", room, glm::dvec3(0), far);
  const Images images =
      lab.last_frame(lab.shipped_graph("lightloom"), scene::load_scene(file), small_run(kSide, kSide, 32));
  return {equal("warnings that the grid is wasted", warnings(file), 1),
          none("such warnings of the room alone", warnings(write_scene(lab.folder(), "inlier", room))),
          none("pixels that are not finite", non_finite_texels(images.at("radiance")))};
}

}  // namespace

void add_shape_checks(std::vector<Check>& checks) {
  checks.push_back({.name = "thin_walls",
                    .group = "geometry",
                    .extreme = "a closed room with slanting walls without thickness, 1e6 W/m^2/sr outside",
                    .danger = "voxelization with holes, marches that step over corners: light leaks in",
                    .guard = "every voxel that a triangle touches is taken, and every voxel that a ray touches is met: "
                             "shaders/lib/supercover.glsl, march.glsl",
                    .measure = measure_thin});
  checks.push_back({.name = "stored_directions",
                    .group = "geometry",
                    .extreme = "262144 normals and tangents in three bytes of a voxel",
                    .danger = "directions far from those that were stored, or none at all",
                    .guard = "the tangent's frame is made of the stored normal: shaders/lib/voxel_encoding.glsl",
                    .measure = measure_directions});
  checks.push_back({.name = "flat_scenes",
                    .group = "geometry",
                    .extreme = "a plane without thickness, a single triangle",
                    .danger = "bounds without volume divide by zero",
                    .guard = "bounds get a thickness, grids at least three voxels a side: framework/scene/bounds.cpp, "
                             "framework/run/grid.cpp",
                    .measure = measure_flat});
  checks.push_back({.name = "far_outlier",
                    .group = "geometry",
                    .extreme = "one triangle 250 times the room's size away from it",
                    .danger = "the whole room in a few voxels, and nobody knows why",
                    .guard = "loading says so: far_outlier_warning, framework/scene/origin.hpp",
                    .measure = measure_outlier});
}

}  // namespace lightloom::stability
