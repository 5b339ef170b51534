#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/scene/scene.hpp"
#include "framework/stability/check.hpp"
#include "framework/stability/light_lab.hpp"
#include "framework/stability/statistics.hpp"

namespace lightloom::stability {
namespace {

const TraceOptions kTrace{.params = R"("paths": 4, "bounces": 2)", .frames = 3};

/// What is left of all that shines.
scene::Scene only(bool lamp, bool sun, bool sky, bool punctual) {
  scene::Scene scene = room_of_all_lights();
  if (!lamp) scene.materials[1].emission = glm::vec3(0);
  if (!sun) scene.sun.reset();
  if (!sky) scene.environment = {};
  if (!punctual) scene.punctual.clear();
  scene.features.emissive = lamp;
  scene.features.sun = sun;
  scene.features.environment = scene.features.environment_image = sky;
  scene.features.punctual = punctual;
  return scene;
}

std::vector<Figure> measure_sum(Lab& lab) {
  std::vector<Figure> figures;
  for (const bool faces : {true, false}) {
    TraceOptions options = kTrace;
    options.faces = faces;
    const auto rendered = [&](const scene::Scene& scene) { return trace(lab, scene, options).back().at("radiance"); };
    const image::HostImage all = rendered(room_of_all_lights());
    options.faces = faces;
    const image::HostImage lamp = rendered(only(true, false, false, false));
    options.faces = false;
    const std::vector<image::HostImage> rest = {rendered(only(false, true, false, false)),
                                                rendered(only(false, false, true, false)),
                                                rendered(only(false, false, false, true))};
    double off = 0, largest = 0;
    for (uint32_t y = 0; y < all.desc.extent.height; ++y)
      for (uint32_t x = 0; x < all.desc.extent.width; ++x)
        for (uint32_t channel = 0; channel < 3; ++channel) {
          double sum = lamp.at(x, y, 0, channel);
          for (const image::HostImage& part : rest) sum += part.at(x, y, 0, channel);
          off = std::max(off, std::abs(sum - all.at(x, y, 0, channel)));
          largest = std::max(largest, sum);
        }
    figures.push_back(at_most(std::string("lamp, sun, sky and point light together, against their sum") +
                                  (faces ? ", lamp by faces" : ", lamp by hints"),
                              off / largest, 1e-5, "of the brightest"));
  }
  return figures;
}

std::vector<Figure> measure_doubled(Lab& lab) {
  scene::Scene one = only(false, false, false, true), two = one, four = one;
  two.punctual.push_back(one.punctual.front());
  for (int k = 0; k < 3; ++k) four.punctual.push_back(one.punctual.front());
  const auto rendered = [&](const scene::Scene& scene) { return trace(lab, scene, kTrace).back().at("radiance"); };
  const image::HostImage base = rendered(one);
  return {at_most("two lights of the same place against one", difference_to_scaled(rendered(two), base, 2), 0,
                  "of the brightest"),
          at_most("four against one", difference_to_scaled(rendered(four), base, 4), 0, "of the brightest")};
}

std::vector<Figure> measure_sun(Lab& lab) {
  const auto frames = [&](const scene::Scene& scene) { return trace(lab, scene, kTrace); };
  scene::Scene none_there = only(true, false, false, true), black = none_there, point = only(false, true, false, false);
  black.sun = scene::Sun{glm::vec3(0, -1, 0), glm::vec3(0), 0.1f};
  black.features.sun = true;
  // A floor alone, under a sun that fills the sky's half: what arrives is the irradiance, whatever the radius.
  scene::Material white = white_lambertian();
  scene::Scene floor =
      make_quad_scene({{{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}}}, {white}, look_at({0, 3, 0}, {0, 0, 0}, 0.5f, {0, 0, -1}));
  floor.features.sun = true;
  std::vector<Figure> figures = {
      none("texels that change by a sun of irradiance 0",
           differing_texels(frames(none_there).back().at("radiance"), frames(black).back().at("radiance")))};
  for (const double radius : {0.0, 1e-6, 0.0046524, 1.0, std::numbers::pi / 2}) {
    floor.sun = scene::Sun{glm::vec3(0, -1, 0), glm::vec3(3), static_cast<float>(radius)};
    SampleMean light;
    for (const Images& images : trace(lab, floor, {.params = R"("paths": 16, "bounces": 0)", .frames = 8}))
      light.add(mean_channel(images.at("radiance"), 0));
    const double exact = 3 / std::numbers::pi;
    // What sees no edge of the disc has no noise to speak of.
    const double error = std::max(light.error(), 1e-6 * exact);
    figures.push_back(at_most("white floor under a sun of radius " + std::to_string(radius) + ", off irradiance / pi",
                              std::abs(light.mean() - exact) / error, 3, "standard errors"));
  }
  return figures;
}

/// Light of a white floor's point under a point light that is `distance` away, in 1e-4 voxels; over what arrives from
/// straight above at a distance of 1.
double light_beside_floor(Lab& lab, double distance) {
  constexpr float kSide = 4;
  scene::Scene floor =
      make_quad_scene({{{-kSide / 2, 0, kSide / 2}, {kSide, 0, 0}, {0, 0, -kSide}}}, {white_lambertian()},
                      look_at({0.3f, 3, 0.2f}, {0.3f, 0, 0.2f}, 0.5f, {0, 0, -1}));
  floor.punctual.emplace_back().intensity = glm::vec3(1);
  floor.features.punctual = true;
  const TraceOptions options{.params = R"("paths": 1, "bounces": 0)"};
  // The light goes over the very point that a pixel shows.
  const image::HostImage places = trace(lab, floor, options).back().at("position");
  constexpr uint32_t kPixel = 13;
  const auto place = [&](uint32_t channel) { return static_cast<float>(places.at(kPixel, kPixel, 0, channel)); };
  const double least = 1e-4 * kSide / options.resolution;
  floor.punctual[0].position = glm::vec3(place(0), place(1) + static_cast<float>(distance * least), place(2));
  const double light = trace(lab, floor, options).back().at("radiance").at(kPixel, kPixel, 0, 0);
  return light * std::numbers::pi * least * least;
}

std::vector<Figure> measure_punctual(Lab& lab) {
  std::vector<Figure> figures;
  double bad = 0;
  scene::Scene scene = only(false, false, false, true);
  // On the floor, 1e-6 m and a voxel over it.
  for (const float height : {0.0f, 1e-6f, 0.125f}) {
    scene.punctual[0].position = glm::vec3(0.5f, height, 1);
    for (const Images& images : trace(lab, scene, kTrace)) bad += non_finite(images.at("radiance"));
  }
  figures.push_back(none("values that are not finite, light on the floor, 1e-6 m and a voxel over it", bad));
  const double beside = light_beside_floor(lab, 0.1);
  figures.push_back(at_most("light a tenth of the least distance over the floor, against that at it", beside, 1));
  figures.push_back(at_least("the same, which is not lost", beside, 0.01));
  scene = only(false, false, false, true);
  const auto rendered = [&] { return trace(lab, scene, kTrace).back().at("radiance"); };
  const image::HostImage unlimited = rendered();
  scene.punctual[0].range = 1e6f;
  figures.push_back(at_most("range 0, which is none, against 1000 km", difference_to_scaled(rendered(), unlimited, 1),
                            1e-6, "of the brightest"));
  scene.punctual[0].range = 1e-3f;
  figures.push_back(at_most("light of a light of range 1 mm", mean_channel(rendered(), 0), 0));
  scene.punctual[0] = room_of_all_lights().punctual[0];
  scene.punctual[0].type = scene::PunctualType::spot;
  scene.punctual[0].direction = glm::vec3(0, -1, 0);
  scene.punctual[0].inner_cone = 0.4999f;
  scene.punctual[0].outer_cone = 0.5f;
  figures.push_back(none("values that are not finite, a spot whose cones are 1e-4 apart", non_finite(rendered())));
  return figures;
}

/// Whether a scene file is refused as invalid with a sentence that has `part`.
bool refused(Lab& lab, const std::string& name, const std::string& text, const std::string& part) {
  const std::filesystem::path file = lab.folder() / name;
  std::ofstream(file) << text;
  try {
    (void)scene::load_scene(file);
  } catch (const Error& error) {
    return error.code() == ExitCode::invalid_input && std::string(error.what()).find(part) != std::string::npos;
  }
  return false;
}

std::string gltf(const std::string& light) {
  return R"({ "asset": { "version": "2.0" }, "extensionsUsed": ["KHR_lights_punctual"],
    "extensions": { "KHR_lights_punctual": { "lights": [ )" +
         light + R"( ] } },
    "nodes": [ { "extensions": { "KHR_lights_punctual": { "light": 0 } } } ], "scenes": [ { "nodes": [0] } ], "scene": 0 })";
}

std::vector<Figure> measure_refused(Lab& lab) {
  double accepted = 0;
  const auto must_refuse = [&](const std::string& name, const std::string& text, const std::string& part) {
    if (!refused(lab, name, text, part)) ++accepted;
  };
  must_refuse("equal_cones.gltf",
              gltf(R"({ "type": "spot", "spot": { "innerConeAngle": 0.5, "outerConeAngle": 0.5 } })"),
              "innerConeAngle");
  must_refuse("negative_intensity.gltf", gltf(R"({ "type": "point", "intensity": -1 })"), "intensity");
  must_refuse("negative_color.gltf", gltf(R"({ "type": "point", "color": [1, -1, 0] })"), "color");
  must_refuse("negative_range.gltf", gltf(R"({ "type": "point", "range": -2 })"), "range");
  const auto scene_file = [](const std::string& light) {
    return R"({ "lightloom_scene": 1, "gltf": "none.gltf", )" + light + " }";
  };
  must_refuse("sun.scene.json", scene_file(R"("sun": { "direction": [0, -1, 0], "irradiance": [1, -1, 1] })"),
              "irradiance");
  must_refuse(
      "sun_radius.scene.json",
      scene_file(R"("sun": { "direction": [0, -1, 0], "irradiance": [1, 1, 1], "angular_radius_degrees": 90 })"),
      "angular_radius_degrees");
  must_refuse("sky.scene.json", scene_file(R"("environment": { "radiance": [1, 1, -1] })"), "radiance");
  must_refuse("direction.scene.json", scene_file(R"("sun": { "direction": [0, 0, 0], "irradiance": [1, 1, 1] })"),
              "direction");
  return {none("files that are accepted, or refused for another reason, of 8", accepted)};
}

std::vector<Figure> measure_seeds(Lab& lab) {
  const scene::Scene scene = room_of_all_lights();
  TraceOptions options{.params = R"("paths": 1, "bounces": 2)", .frames = 16};
  const std::vector<uint32_t> seeds = {7, 8, 7 + (1u << 16), 7 + (1u << 31)};
  // Over the mean of all pictures, what is left of each is noise.
  std::vector<std::vector<double>> pictures(seeds.size());
  std::vector<SampleMean> means(seeds.size());
  for (size_t k = 0; k < seeds.size(); ++k) {
    options.seed = seeds[k];
    const std::vector<Images> frames = trace(lab, scene, options);
    for (const Images& images : frames) means[k].add(mean_channel(images.at("radiance"), 1));
    for (uint32_t y = 0; y < options.size; ++y)
      for (uint32_t x = 0; x < options.size; ++x)
        // Noise alone: the difference of two frames of the same seed.
        pictures[k].push_back(frames[0].at("radiance").at(x, y, 0, 1) - frames[1].at("radiance").at(x, y, 0, 1));
  }
  double z = 0, correlated = 0;
  for (size_t a = 0; a < seeds.size(); ++a)
    for (size_t b = a + 1; b < seeds.size(); ++b) {
      z = std::max(z, std::abs(means[a].mean() - means[b].mean()) / std::hypot(means[a].error(), means[b].error()));
      correlated = std::max(correlated, std::abs(correlation(pictures[a], pictures[b])) * options.size);
    }
  return {at_most("means of four seeds, the largest difference of a pair", z, 3, "standard errors"),
          at_most("noise of the pictures, the largest correlation of a pair", correlated, 3, "standard deviations")};
}

std::vector<Figure> measure_grazing(Lab& lab) {
  std::vector<Figure> figures;
  for (const char* form : {"bounded", "1992"})
    for (const float roughness : {0.1f, 0.4f, 0.8f}) {
      scene::Material metal;
      metal.roughness = roughness;
      metal.double_sided = true;
      // 89.9 degrees off the normal at the centre of the picture, which the plane fills in its lower half.
      const double slope = std::tan(0.1 * std::numbers::pi / 180);
      scene::Scene plane = make_quad_scene({{{-60, 0, 60}, {120, 0, 0}, {0, 0, -120}}}, {metal},
                                           look_at({0, static_cast<float>(50 * slope), 50}, {0, 0, 0}, 0.002f));
      plane.environment.radiance = glm::vec3(1);
      plane.features.environment = plane.features.metallic = true;
      double largest = 0, bad = 0;
      SampleMean mean;
      for (const Images& images :
           trace(lab, plane,
                 {.params = R"("paths": 1, "bounces": 1, "ward": ")" + std::string(form) + "\"", .frames = 8})) {
        const image::HostImage& radiance = images.at("radiance");
        bad += non_finite(radiance);
        mean.add(mean_channel(radiance, 0));
        for (uint32_t y = 0; y < radiance.desc.extent.height; ++y)
          for (uint32_t x = 0; x < radiance.desc.extent.width; ++x)
            largest = std::max(largest, radiance.at(x, y, 0, 0));
      }
      const std::string which = std::string(form) + ", roughness " + std::to_string(roughness).substr(0, 3) + ": ";
      figures.push_back(none(which + "values that are not finite", bad));
      // Ward 1992 darkens by the root of the cosine, which shading normals keep at 0.02 or more, and is as much too
      // bright beside the few paths that leave so low.
      const bool bounded = std::string(form) == "bounded";
      figures.push_back(
          at_most(which + "brightest path of one under a sky of 1", largest, bounded ? 2 + 1e-3 : 1 / std::sqrt(0.02)));
      if (!bounded) continue;
      figures.push_back(at_most(which + "mean, of what arrives", mean.mean(), 1 + 3 * mean.error()));
      figures.push_back(at_most(which + "brightest path over the mean", largest / mean.mean(), 10));
    }
  return figures;
}

}  // namespace

void add_source_checks(std::vector<Check>& checks) {
  const auto add = [&](std::string group, std::string name, std::string extreme, std::string danger, std::string guard,
                       std::function<std::vector<Figure>(Lab&)> measure) {
    checks.push_back({.name = std::move(name),
                      .group = std::move(group),
                      .extreme = std::move(extreme),
                      .danger = std::move(danger),
                      .guard = std::move(guard),
                      .measure = std::move(measure)});
  };
  const std::string lights = "light sources";
  add(lights, "light_sum", "lamp, sun, sky and point light together",
      "one source takes the random numbers of another, or is counted twice",
      "a dimension of the random numbers for each: shaders/lib/random.glsl; shares by density: shaders/lib/mis.glsl",
      measure_sum);
  add(lights, "doubled_lights", "two and four identical lights in one place",
      "the number of lights is no factor of their light",
      "one is picked uniformly and counts times their number: shaders/lib/punctual.glsl", measure_doubled);
  add(lights, "sun_extremes", "a sun of irradiance 0; of radius 0, 1e-6, 0.27, 57 and 90 degrees",
      "0/0 in the density of a point", "a sun without extent has no density: shaders/lib/sun.glsl", measure_sun);
  add(lights, "punctual_extremes", "a point light on a surface, ranges of 0 and 1 mm, a spot without a rim",
      "1/d^2 without a bound, division by a range of 0",
      "a least distance of 1e-4 voxels, range 0 is none: shaders/lib/punctual.glsl", measure_punctual);
  add(lights, "refused_lights", "equal cones, negative intensities, colours and ranges, a sun without direction",
      "negative light, division by 0", "ranges of every number: framework/scene/gltf_schema.cpp, scene_keys.hpp",
      measure_refused);
  add("random numbers", "picture_seeds", "pictures of seeds 1, 2^16 and 2^31 apart",
      "noise that two runs share, a mean that depends on the seed",
      "the seed is a word of the key: shaders/lib/random.glsl", measure_seeds);
  add("materials", "grazing_plane", "a metal plane seen at 89.9 degrees under a sky of 1",
      "samples of many times what arrives",
      "weights of at most 2 for the bounded lobe: shaders/lib/ward.glsl, ward_weight", measure_grazing);
}

}  // namespace lightloom::stability
