#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "framework/scene/lights.hpp"
#include "framework/stability/check.hpp"
#include "framework/stability/differences.hpp"
#include "framework/stability/rooms.hpp"
#include "framework/stability/scene_files.hpp"

namespace lightloom::stability {
namespace {

constexpr uint32_t kWidth = 48, kHeight = 36;
constexpr uint32_t kResolution = 34;  ///< furnished_room's walls lie on borders of voxels of 1/8 m

/// The whole graph. What is stored in half floats takes steps of 2^-11, which a difference in the last bit of a float
/// may cross; `wide` stores floats instead.
RunOptions whole_run(bool wide = false) {
  RunOptions options = small_run(kWidth, kHeight, kResolution);
  options.link.variants.clear();
  options.frames = 3;
  for (const char* part : {"normal", "geometric_normal", "tangent", "albedo", "material", "emission"})
    if (wide) options.link.formats.emplace_back(std::string("*.surface.") + part, "rgba32_sfloat");
  return options;
}

RunOptions reference_run() {
  RunOptions options = small_run(24, 18, kResolution);
  options.link.variants.clear();
  options.link.sets = {{"paths", "8"}};
  return options;
}

image::HostImage radiance(Lab& lab, const std::string& graph, const scene::Scene& scene, const RunOptions& options) {
  return lab.last_frame(lab.shipped_graph(graph), scene, options).at("radiance");
}

double emitting_area(const scene::Scene& scene) {
  return scene::EmitterSampler(scene, scene::build_emission_table(scene)).emitting_area(1);
}

std::vector<Figure> measure_scale(Lab& lab) {
  const scene::Scene room = furnished_room();
  const image::HostImage traced = radiance(lab, "lightloom", room, whole_run());
  const image::HostImage wide = radiance(lab, "lightloom", room, whole_run(true));
  const image::HostImage reference = radiance(lab, "reference", room, reference_run());
  std::vector<Figure> figures;
  double area_error = 0;
  for (const auto& [scale, name] : {std::pair(std::ldexp(1.0f, -20), "2^-20"), {std::ldexp(1.0f, 20), "2^20"}}) {
    const scene::Scene other = placed(room, {.scale = scale});
    const std::string at = std::string(", scale ") + name;
    figures.push_back(
        none("pixels with other bits" + at, differing_texels(traced, radiance(lab, "lightloom", other, whole_run()))));
    figures.push_back(none("pixels with other bits, reference" + at,
                           differing_texels(reference, radiance(lab, "reference", other, reference_run()))));
  }
  for (const auto& [scale, name] : {std::pair(1e-6f, "1e-6"), {1e-3f, "1e-3"}, {1e3f, "1e3"}, {1e6f, "1e6"}}) {
    const scene::Scene other = placed(room, {.scale = scale});
    const std::string at = std::string(", scale ") + name;
    figures.push_back(at_most("largest relative difference" + at,
                              largest_relative_difference(wide, radiance(lab, "lightloom", other, whole_run(true))),
                              1e-4, "relative"));
    figures.push_back(at_most("the same with a G-buffer of half floats" + at,
                              largest_relative_difference(traced, radiance(lab, "lightloom", other, whole_run())),
                              std::ldexp(1, -10), "relative"));
    figures.push_back(at_most(
        "largest relative difference, reference" + at,
        largest_relative_difference(reference, radiance(lab, "reference", other, reference_run())), 1e-4, "relative"));
    const double expected = emitting_area(room) * static_cast<double>(scale) * static_cast<double>(scale);
    area_error = std::max(area_error, std::abs(emitting_area(other) / expected - 1));
  }
  figures.push_back(at_most("error of the lamp's area over scale^2", area_error, 1e-5, "relative"));
  return figures;
}

/// What a scene file shows: its picture and its voxels.
Images picture_of(Lab& lab, const std::filesystem::path& file) {
  RunOptions options = small_run(kWidth, kHeight, kResolution);
  options.capture = {"voxelize_static.voxels.*"};
  return lab.last_frame(lab.shipped_graph("lightloom"), scene::load_scene(file), options);
}

double differing_voxels(const Images& a, const Images& b) {
  double differing = 0;
  for (const char* part : {"albedo", "normal", "material"}) {
    const std::string name = std::string("voxelize_static.voxels.") + part;
    differing += differing_texels(a.at(name), b.at(name));
  }
  return differing;
}

std::vector<Figure> measure_offset(Lab& lab) {
  const scene::Scene room = furnished_room();
  const Images at_home = picture_of(lab, write_scene(lab.folder(), "home", room));
  std::vector<Figure> figures;
  // Whole numbers of voxels of 1/8 m, most of them no powers of two.
  const std::vector<std::pair<std::string, glm::dvec3>> shifts = {
      {"1e5 m", {1e5 + 0.125, 0, 0}}, {"1e6 m", {0, -1e6 + 0.375, 1e6}}, {"1e7 m", {1e7, 1e7 + 2.5, -1e7}}};
  for (const auto& [name, shift] : shifts) {
    const Images there = picture_of(lab, write_scene(lab.folder(), "far", room, shift));
    figures.push_back(none("voxels with other bits at " + name, differing_voxels(at_home, there)));
    figures.push_back(
        at_least("PSNR at " + name, peak_signal_to_noise(at_home.at("radiance"), there.at("radiance")), 60, "dB"));
  }
  return figures;
}

/// Triangles without a surface: points, lines, and some that are less than any length high. Corners are multiples of
/// 2^-13, so that those of a line lie on it.
std::vector<glm::vec3> bad_triangles(size_t count) {
  std::vector<glm::vec3> corners;
  for (size_t i = 0; i < count; ++i) {
    const float t = static_cast<float>(i) / 1024;
    const glm::vec3 a(1.5f * t - 0.75f, t - 0.5f, 0.5f - t), b = a + glm::vec3(0.25f, 0.5f * t, -0.125f);
    switch (i % 4) {
      case 0:
        corners.insert(corners.end(), {a, a, a});
        break;
      case 1:
        corners.insert(corners.end(), {a, b, b});
        break;
      case 2:
        corners.insert(corners.end(), {a, b, a + 2.0f * (b - a)});
        break;
      default:
        corners.insert(corners.end(), {a, a + glm::vec3(1, 0, 0), a + glm::vec3(0.5f, 1e-38f, 0)});
    }
  }
  return corners;
}

/// The scene with triangles of material 0 behind its own, as an animation may make them: past the loader.
scene::Scene with_triangles(scene::Scene scene, const std::vector<glm::vec3>& corners) {
  const auto object = static_cast<uint32_t>(scene.objects.size());
  scene.objects.emplace_back("bad");
  for (size_t i = 0; i < corners.size(); i += 3) {
    const auto base = static_cast<uint32_t>(scene.vertices.size());
    for (size_t k = 0; k < 3; ++k) scene.vertices.emplace_back().position = corners[i + k];
    scene.triangles.push_back({base, base + 1, base + 2, 0, object});
  }
  scene.static_vertex_count = static_cast<uint32_t>(scene.vertices.size());
  scene.static_triangle_count = static_cast<uint32_t>(scene.triangles.size());
  return scene;
}

std::vector<glm::vec3> non_finite_triangles(size_t count) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  std::vector<glm::vec3> corners = bad_triangles(count);
  for (size_t i = 0; i < corners.size(); i += 3) {
    corners[i + 1] = corners[i] + glm::vec3(0.5f, 0, 0);
    corners[i + 2] = corners[i] + glm::vec3(0, 0.5f, 0);
    corners[i + i / 3 % 3][static_cast<int>(i / 9 % 3)] = i % 2 == 0 ? nan : i % 4 == 1 ? infinity : -infinity;
  }
  return corners;
}

std::vector<Figure> measure_degenerate(Lab& lab) {
  constexpr size_t kBad = 1000;
  const scene::Scene room = furnished_room();
  const std::filesystem::path file = write_scene(lab.folder(), "bad", room, glm::dvec3(0), bad_triangles(kBad));
  double said = 0;
  for (const std::string& warning : scene::load_scene(file).warnings)
    said += warning.starts_with(std::to_string(kBad) + " degenerate triangles") ? 1 : 0;
  const Images clean = picture_of(lab, write_scene(lab.folder(), "clean", room));
  const Images loaded = picture_of(lab, file);
  std::vector<Figure> figures = {
      equal("warnings that 1000 triangles were dropped", said, 1),
      none("voxels with other bits, loaded", differing_voxels(clean, loaded)),
      none("pixels with other bits, loaded", differing_texels(clean.at("radiance"), loaded.at("radiance")))};

  RunOptions options = small_run(kWidth, kHeight, kResolution);
  options.capture = {"voxelize_static.voxels.*"};
  const std::string graph = lab.shipped_graph("lightloom");
  const Images alone = lab.last_frame(graph, room, options);
  const image::HostImage reference = radiance(lab, "reference", room, reference_run());
  for (const auto& [name, corners] :
       {std::pair("without area", bad_triangles(kBad)), std::pair("not finite", non_finite_triangles(kBad))}) {
    const scene::Scene spoilt = with_triangles(room, corners);
    const Images shown = lab.last_frame(graph, spoilt, options);
    const std::string kind = std::string(", posed ") + name;
    figures.push_back(none("voxels with other bits" + kind, differing_voxels(alone, shown)));
    figures.push_back(
        none("pixels with other bits" + kind, differing_texels(alone.at("radiance"), shown.at("radiance"))));
    figures.push_back(none("pixels with other bits, reference" + kind,
                           differing_texels(reference, radiance(lab, "reference", spoilt, reference_run()))));
  }
  return figures;
}

}  // namespace

void add_geometry_checks(std::vector<Check>& checks) {
  checks.push_back({.name = "scene_scale",
                    .group = "geometry",
                    .extreme = "a scene 1e-6 to 1e6 times as large",
                    .danger = "epsilons in metres skip or leak everything",
                    .guard = "epsilons in voxels, pixels or relative: shaders/lib/ray_start.glsl, grid.glsl",
                    .measure = measure_scale});
  checks.push_back({.name = "far_from_origin",
                    .group = "geometry",
                    .extreme = "a scene of 4 m at a distance of 1e5 to 1e7 m",
                    .danger = "floats resolve 1 m at 1e7 m: voxels and shadows jitter, small things vanish",
                    .guard = "transforms composed in double, less an origin near the scene: framework/scene/origin.hpp",
                    .measure = measure_offset});
  checks.push_back({.name = "degenerate_triangles",
                    .group = "geometry",
                    .extreme = "1000 triangles without area or with corners that are not finite",
                    .danger = "normals that are not numbers, infinite bounds",
                    .guard =
                        "dropped and counted on load: framework/scene/primitive.cpp; those that an animation makes "
                        "claim no voxels: shaders/voxelize_claim.comp",
                    .measure = measure_degenerate});
}

}  // namespace lightloom::stability
