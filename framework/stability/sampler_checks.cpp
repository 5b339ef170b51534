#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "framework/scene/lights.hpp"
#include "framework/stability/check.hpp"
#include "framework/stability/scenes.hpp"

namespace lightloom::stability {
namespace {

constexpr double kSunRadius = 0.0046524;  ///< of the real sun as seen from the earth [radians]

enum Sampler : uint32_t { cosine, ward, cone, environment, punctual_choice, sun };

scene::Scene plain_scene() {
  return make_quad_scene({{{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}}}, {}, look_at({0, 2, 2}, {0, 0, 0}, 0.8f));
}

/// With a sun, an image of the sky that is black but for two texels, and five punctual lights.
scene::Scene lit_scene(double sun_radius) {
  scene::Scene scene = plain_scene();
  scene.sun = scene::Sun{glm::normalize(glm::vec3(0.3f, -1, 0.2f)), glm::vec3(2, 3, 4), static_cast<float>(sun_radius)};
  scene.environment = {glm::vec3(1), 8, 4, std::vector<float>(size_t{8} * 4 * 3, 0.0f)};
  for (const size_t texel : {size_t{0}, size_t{31}})
    for (size_t channel = 0; channel < 3; ++channel) scene.environment.rgb[texel * 3 + channel] = 7;
  for (int k = 0; k < 5; ++k) {
    scene::PunctualLight light;
    light.intensity = glm::vec3(static_cast<float>(k + 1));
    light.position = glm::vec3(0, static_cast<float>(k + 1), 0);
    scene.punctual.push_back(light);
  }
  scene.features.sun = scene.features.environment = scene.features.environment_image = scene.features.punctual = true;
  return scene;
}

struct Sampled {
  image::HostImage directions, extra;
  uint32_t width = 0, height = 0;
};

Sampled sample(Lab& lab, const scene::Scene& scene, Sampler kind, uint32_t width, uint32_t height,
               const std::string& more = "") {
  const std::string size = R"({ "size": ")" + std::to_string(width) + "x" + std::to_string(height) + "\" }";
  Images images = lab.last_frame(
      R"({ "lightloom": 1, "name": "light_edges", "passes": { "edges": { "type": "compute",
      "shader": "stability/light_edges.comp", "out": { "directions": )" +
          size + R"(, "weights": )" + size + R"( }, "params": { "sampler_kind": )" + std::to_string(kind) + more +
          R"( } } }, "outputs": { "directions": "edges.directions", "weights": "edges.weights" } })",
      scene);
  return {std::move(images.at("directions")), std::move(images.at("weights")), width, height};
}

/// Directions that are not finite or not of unit length, and densities that are not finite and above 0.
struct Faults {
  double directions = 0, densities = 0;
};

template <typename Valid>
Faults count_faults(const Sampled& sampled, const Valid& valid) {
  Faults faults;
  for (uint32_t y = 0; y < sampled.height; ++y)
    for (uint32_t x = 0; x < sampled.width; ++x) {
      const auto at = [&](uint32_t channel) { return sampled.directions.at(x, y, 0, channel); };
      const double length = std::hypot(at(0), at(1), at(2));
      if (!(std::abs(length - 1) < 1e-5)) ++faults.directions;
      if (!valid(x, y)) continue;
      if (!(std::isfinite(at(3)) && at(3) > 0)) ++faults.densities;
    }
  return faults;
}

std::vector<Figure> measure_cosine(Lab& lab) {
  const Sampled sampled = sample(lab, plain_scene(), cosine, 9, 1);
  const Faults faults = count_faults(sampled, [](uint32_t, uint32_t) { return true; });
  return {none("directions not of unit length", faults.directions), none("densities not above 0", faults.densities)};
}

std::vector<Figure> measure_ward(Lab& lab) {
  std::vector<Figure> figures;
  for (const char* sampling : {"0", "1"}) {
    const Sampled sampled =
        sample(lab, plain_scene(), ward, 9, 64, R"(, "ward": 2, "ward_sampling": )" + std::string(sampling));
    // A sample below the horizon is lost, and has no density. Narrow lobes never lose one this far above it.
    const auto counts = [&](uint32_t x, uint32_t y) { return sampled.directions.at(x, y, 0, 2) > 1e-6; };
    const Faults faults = count_faults(sampled, counts);
    double lost = 0, bad_halves = 0;
    for (uint32_t y = 0; y < 64; ++y)
      for (uint32_t x = 0; x < 9; ++x) {
        const auto half = [&](uint32_t channel) { return sampled.extra.at(x, y, 0, channel); };
        if (!(std::abs(std::hypot(half(0), half(1), half(2)) - 1) < 1e-5 && half(2) > 0)) ++bad_halves;
        if (std::max(y / 8, y % 8) <= 5 && sampled.directions.at(x, y, 0, 2) <= 0) ++lost;
      }
    const std::string which = *sampling == '0' ? "exact: " : "phi_uniform: ";
    figures.push_back(none(which + "directions not of unit length", faults.directions));
    figures.push_back(none(which + "half vectors not of unit length or below the horizon", bad_halves));
    figures.push_back(none(which + "densities not above 0 of samples that count", faults.densities));
    figures.push_back(none(which + "samples lost at alpha up to 0.1, 53 degrees", lost));
  }
  return figures;
}

std::vector<Figure> measure_cone(Lab& lab) {
  const Sampled sampled = sample(lab, plain_scene(), cone, 9, 8);
  const Faults faults = count_faults(sampled, [](uint32_t, uint32_t) { return false; });
  double outside = 0;
  for (uint32_t y = 0; y < 8; ++y)
    for (uint32_t x = 0; x < 9; ++x)
      // 2 sin^2 of half the angle; both directions are rounded.
      outside = std::max(outside, sampled.extra.at(x, y, 0, 0) - sampled.extra.at(x, y, 0, 1) * (1 + 1e-5));
  return {none("directions not of unit length, cones from a point to a hemisphere", faults.directions),
          at_most("1 - cosine beyond the cone's", outside, 1e-9)};
}

std::vector<Figure> measure_sun(Lab& lab) {
  std::vector<Figure> figures;
  for (const double radius : {kSunRadius, 1e-5, std::numbers::pi / 2}) {
    const scene::Scene scene = lit_scene(radius);
    const Sampled sampled = sample(lab, scene, sun, 9, 1);
    const double half_sine = std::sin(0.5 * static_cast<double>(scene.sun->angular_radius));
    const double drop = 2 * half_sine * half_sine;
    const double density = 1 / (2 * std::numbers::pi * drop);
    const double radiance = 3 / (std::numbers::pi * drop * (2 - drop));
    double off = 0;
    for (uint32_t x = 0; x < 9; ++x) {
      off = std::max(off, std::abs(sampled.directions.at(x, 0, 0, 3) / density - 1));
      off = std::max(off, std::abs(sampled.extra.at(x, 0, 0, 0) / drop - 1));
      off = std::max(off, std::abs(sampled.extra.at(x, 0, 0, 2) / radiance - 1));
    }
    figures.push_back(at_most("1 - cosine, density and radiance at an angular radius of " + std::to_string(radius), off,
                              1e-6, "relative"));
  }
  return figures;
}

/// The image of the sky is black but for some texels.
scene::Scene sky_of(uint32_t width, uint32_t height, const std::vector<size_t>& white) {
  scene::Scene scene = lit_scene(0);
  scene.environment = {glm::vec3(1), width, height, std::vector<float>(size_t{width} * height * 3, 0.0f)};
  for (const size_t texel : white)
    for (size_t channel = 0; channel < 3; ++channel) scene.environment.rgb[texel * 3 + channel] = 7;
  return scene;
}

std::vector<Figure> measure_environment(Lab& lab) {
  struct Sky {
    const char* what;
    uint32_t width, height;
    std::vector<size_t> white;
  };
  // Linear filtering carries the light of a texel over into those beside it.
  const std::vector<Sky> skies = {{"first and last texel", 8, 4, {0, 31}},
                                  {"an image of one texel", 1, 1, {0}},
                                  {"an image of one row, its first texel", 16, 1, {0}},
                                  {"an image of one column, its last texel", 1, 16, {15}},
                                  {"a texel in the middle, black ones before and after", 16, 16, {8 * 16 + 8}},
                                  {"the first texel of many", 16, 16, {0}},
                                  {"the last texel of many", 16, 16, {255}}};
  std::vector<Figure> figures;
  for (const Sky& sky : skies) {
    const Sampled sampled = sample(lab, sky_of(sky.width, sky.height, sky.white), environment, 81, 1);
    const auto found = [&](uint32_t x, uint32_t) { return sampled.extra.at(x, 0, 0, 0) > 0; };
    const Faults faults = count_faults(sampled, found);
    double lost = 0;
    for (uint32_t x = 0; x < 81; ++x) {
      // At the rim of a cell rounding may end in the black one beside it, and the draw is given up.
      const bool at_a_rim = (x / 9) % 3 != 1 || x / 27 != 1;
      if (!found(x, 0) && !at_a_rim) ++lost;
    }
    const std::string which = std::string(sky.what) + ": ";
    figures.push_back(none(which + "directions not of unit length", faults.directions));
    figures.push_back(none(which + "densities not above 0 of what is found", faults.densities));
    figures.push_back(none(which + "draws within a cell that find nothing", lost));
  }
  const Sampled nothing = sample(lab, sky_of(8, 4, {}), environment, 81, 1);
  double found_in_black = 0;
  for (uint32_t x = 0; x < 81; ++x) found_in_black += nothing.extra.at(x, 0, 0, 0);
  figures.push_back(none("draws from a black image", found_in_black));
  return figures;
}

std::vector<Figure> measure_choice(Lab& lab) {
  const Sampled picks = sample(lab, lit_scene(0), punctual_choice, 3, 1);
  return {equal("punctual light of u = 0", picks.extra.at(0, 0, 0, 1), 1),
          equal("punctual light of u = 1/2, of five", picks.extra.at(1, 0, 0, 1), 3),
          equal("punctual light of u = 1 - 2^-24", picks.extra.at(2, 0, 0, 1), 5)};
}

/// Points that the host draws on a triangle, in barycentric coordinates.
std::vector<Figure> measure_triangle(Lab&) {
  scene::Material lamp = white_lambertian();
  lamp.emission = glm::vec3(1);
  scene::Scene scene =
      make_quad_scene({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {lamp}, look_at({0, 2, 2}, {0, 0, 0}, 0.8f));
  const scene::EmissionTable table = scene::build_emission_table(scene);
  const scene::EmitterSampler sampler(scene, table);
  double outside = 0, count = 0;
  glm::dvec2 sum(0), least(1), largest(0);
  for (uint32_t frame = 0; frame < 64; ++frame)
    for (const scene::Hint& hint : sampler.draw_hints(scene, frame * 0x01000193u, frame, 1024)) {
      const glm::dvec2 p(hint.position);
      const bool inside = p.x >= 0 && p.y >= 0 && p.x <= 1 && p.y <= 1 && hint.position.z == 0;
      if (!inside || hint.normal != glm::vec3(0, 0, 1)) ++outside;
      sum += p;
      least = glm::min(least, p);
      largest = glm::max(largest, p);
      ++count;
    }
  const double error = std::sqrt(1 / 12.0 / count);
  return {none("points off the quad of 65536", outside),
          at_most("mean of the points off the middle",
                  std::max(std::abs(sum.x / count - 0.5), std::abs(sum.y / count - 0.5)) / error, 3, "standard errors"),
          at_most("margin that no point fell into", std::max({least.x, least.y, 1 - largest.x, 1 - largest.y}), 1e-3)};
}

std::vector<Figure> measure_shares(Lab& lab) {
  const Images images = lab.last_frame(R"({ "lightloom": 1, "name": "mis_weights", "passes": { "weights": {
      "type": "compute", "shader": "stability/mis_weights.comp", "out": { "shares": { "size": "61x61" } } } },
      "outputs": { "shares": "weights.shares" } })",
                                       plain_scene());
  double balance = 0, power = 0, off_sum = 0;
  for (uint32_t y = 0; y < 61; ++y)
    for (uint32_t x = 0; x < 61; ++x) {
      const auto share = [&](uint32_t channel) { return images.at("shares").at(x, y, 0, channel); };
      const double ratio = std::pow(10.0, static_cast<double>(y) - static_cast<double>(x));
      const auto off = [](double value, double exact) {
        const double difference = std::abs(value - exact);
        return std::isfinite(difference) ? difference : std::numeric_limits<double>::infinity();
      };
      balance = std::max(balance, off(share(0), 1 / (1 + ratio)));
      power = std::max(power, off(share(2), 1 / (1 + ratio * ratio)));
      off_sum = std::max({off_sum, off(share(0) + share(1), 1), off(share(2) + share(3), 1)});
    }
  return {at_most("balance heuristic", balance, 2e-6, "absolute"), at_most("power heuristic", power, 4e-6, "absolute"),
          at_most("sum of both shares less 1", off_sum, 2e-6, "absolute")};
}

}  // namespace

void add_sampler_checks(std::vector<Check>& checks) {
  const CheckGroup add(checks, "samplers");
  add("cosine_edges", "random numbers 0 and 1 - 2^-24 in each coordinate", "a direction in the horizon has density 0",
      "numbers end below 1: shaders/lib/random.glsl; shaders/lib/bsdf.glsl, sample_cosine_hemisphere", measure_cosine);
  add("ward_edges", "the same for 64 pairs of alpha in both samplings", "log(0), half vectors in the plane",
      "log(1 - u) with u below 1: shaders/lib/ward.glsl, ward_sample_half_vector", measure_ward);
  add("cone_edges", "the same for cones of 1 - cosine 0 to 1", "directions outside of the cone, where the sun is not",
      "the radius from the drop, not from the cosine: shaders/lib/sampling.glsl, sample_cone", measure_cone);
  add("sun_cone", "angular radius of the real sun, of 1e-5 and of 90 degrees",
      "1 - cos in 32-bit floats is 0.21 % off at the sun's size",
      "2 sin^2 of the half angle in double: framework/run/frame_state.cpp", measure_sun);
  add("environment_edges",
      "the same for images of one texel, row and column, black but for a texel at an end or in the middle, and black",
      "a black texel is drawn with density 0, the search runs over the end",
      "probabilities in steps of 2^-24 that end at 1: framework/scene/environment_sampler.cpp", measure_environment);
  add("punctual_choice", "one of five lights by a number next to 1", "an index past the end",
      "the index is clamped: shaders/lib/punctual.glsl, pick_punctual", measure_choice);
  add("triangle_points", "65536 points on an emissive quad",
      "points beside the triangle, corners that are never reached",
      "coordinates that add up to at most 1: framework/scene/lights.cpp, triangle_point", measure_triangle);
  add("mis_shares", "densities of 1e-30 to 1e30 in all pairs", "squares of densities above 1.8e19 overflow to NaN",
      "the ratio is squared, not the densities: shaders/lib/sampling.glsl, power_weight", measure_shares);
}

}  // namespace lightloom::stability
