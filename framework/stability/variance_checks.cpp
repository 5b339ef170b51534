#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "framework/stability/check.hpp"
#include "framework/stability/light_lab.hpp"

namespace lightloom::stability {
namespace {

constexpr double kLargestSquare =
    1e36;                           ///< square of the brightest light that is traced: shaders/lib/traced_light.glsl
constexpr double kRounding = 1e-6;  ///< of such a number in 32 bits

/// Noise of this mean and width over a plane, filtered in time and then along the surface: with the variance that the
/// mean over time has, or without one. `temporal` false: the pass hands the frames on, with no variance known.
std::string filtered_noise(uint32_t size, double mean, bool temporal, bool guided) {
  const std::string number = std::to_string(mean), side = std::to_string(size);
  const std::string variance = guided ? R"(, "variance": "temporal.variance")" : "";
  return R"({ "lightloom": 1, "name": "unknown_variance", "view": { "width": )" + side + R"(, "height": )" + side +
         R"( }, "passes": {
      "gather": { "type": "gather" },
      "frames": { "type": "compute", "shader": "stability/known_frames.comp", "params": { "mean": )" +
         number + R"(, "width": )" + number + R"(, "bad_frame": 0, "bad_bits": 0 } },
      "temporal": { "type": "temporal_accumulate", "enabled": )" +
         (temporal ? "true" : "false") +
         R"(, "in": { "radiance": "frames.radiance", "surface": "gather.surface", "trail": "frames.radiance@1..9",
            "trail_position": "gather.surface.position@1..9", "trail_normal": "gather.surface.normal@1..9",
            "trail_id": "gather.surface.id@1..9" } },
      "denoise": { "type": "denoise_radial", "in": { "radiance": "temporal.radiance", "surface": "gather.surface")" +
         variance + R"( }, "params": { "floor_fraction": 0.1 } } },
    "outputs": { "radiance": "denoise.radiance", "variance": "temporal.variance", "frames": "frames.radiance" } })";
}

scene::Scene plane() {
  return make_quad_scene({{{-2, 0, 2}, {4, 0, 0}, {0, 0, -4}}}, {}, look_at({0, 2, 0}, {}, 0.8f, {0, 0, -1}));
}

/// Least variance of a picture; not a number where one is none.
double least_variance(const image::HostImage& image) {
  double least = std::numeric_limits<double>::infinity();
  for (uint32_t y = 0; y < image.desc.extent.height; ++y)
    for (uint32_t x = 0; x < image.desc.extent.width; ++x) {
      const double value = image.at(x, y, 0, 0);
      if (!(value < std::numeric_limits<double>::infinity())) return std::numeric_limits<double>::quiet_NaN();
      least = std::min(least, value);
    }
  return least;
}

std::vector<Figure> measure_unknown(Lab& lab) {
  const scene::Scene scene = plane();
  const double bound = kLargestSquare * (1 - kRounding);
  RunOptions six;
  six.frames = 6;
  std::vector<Figure> figures = {
      at_least("variance of a single frame of a single pixel",
               least_variance(lab.last_frame(filtered_noise(1, 1, true, false), scene).at("variance")), bound),
      at_least("variance of six frames whose squares overflow",
               least_variance(lab.last_frame(filtered_noise(8, 1e25, true, false), scene, six).at("variance")), bound)};
  for (const auto& [mean, name] : {std::pair(1.0, "1"), {1e8, "1e8"}, {1e17, "1e17"}}) {
    const Images with = lab.last_frame(filtered_noise(24, mean, false, true), scene);
    const Images without = lab.last_frame(filtered_noise(24, mean, false, false), scene);
    figures.push_back(none(std::string("pixels in which a filter told that the variance is unknown differs from one "
                                       "told nothing, light of ") +
                               name,
                           differing_texels(with.at("radiance"), without.at("radiance"))));
    figures.push_back(equal(std::string("pixels that it changes, light of ") + name,
                            differing_texels(with.at("radiance"), with.at("frames")), 24 * 24));
  }
  return figures;
}

}  // namespace

void add_variance_checks(std::vector<Check>& checks) {
  const CheckGroup add(checks, "accumulation");
  add("unknown_variance",
      "a variance that nobody knows: one frame of one pixel, squares that overflow, a disabled pass",
      "bright light is taken for well known, and the filters leave its noise",
      "above the square of all light that is traced: shaders/lib/variance.glsl, passes/temporal_accumulate.cpp, "
      "kUnknownVariance",
      measure_unknown);
}

}  // namespace lightloom::stability
