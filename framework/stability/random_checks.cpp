#include <cmath>

#include "framework/stability/check.hpp"
#include "framework/stability/scenes.hpp"

namespace lightloom::stability {
namespace {

scene::Scene any_scene() {
  return make_quad_scene({{{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}}}, {}, look_at({0, 2, 2}, {0, 0, 0}, 0.8f));
}

std::vector<Figure> measure_uniform_floats(Lab& lab) {
  const Images images = lab.last_frame(R"({ "lightloom": 1, "name": "uniform_floats", "passes": {
      "numbers": { "type": "compute", "shader": "stability/uniform_floats.comp",
                   "out": { "numbers": { "format": "rgba32_sfloat", "size": "4x1" } } } },
      "outputs": { "numbers": "numbers.numbers" } })",
                                       any_scene());
  const image::HostImage& numbers = images.at("numbers");
  double error = 0;
  for (uint32_t i = 0; i < 4; ++i)
    error = std::max(error, std::abs(numbers.at(i, 0, 0, 0) - std::floor(0x55555555u * double(i) / 256) / 16777216));
  return {equal("1 - number made of 0xffffffff", 1 - numbers.at(3, 0, 0, 0), std::pow(2, -24)),
          equal("number made of 0", numbers.at(0, 0, 0, 0), 0), at_most("largest error of four numbers", error, 0)};
}

}  // namespace

void add_random_checks(std::vector<Check>& checks) {
  checks.push_back({.name = "uniform_floats",
                    .group = "random numbers",
                    .extreme = "32 random bits that are all ones",
                    .danger = "bits * 2^-32 rounds to 1 in 32-bit floats, outside [0, 1)",
                    .guard = "24 bits are kept: shaders/lib/random.glsl, uniform_floats",
                    .measure = measure_uniform_floats});
}

}  // namespace lightloom::stability
