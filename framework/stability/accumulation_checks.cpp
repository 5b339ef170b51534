#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "framework/stability/check.hpp"
#include "framework/stability/light_lab.hpp"
#include "framework/stability/statistics.hpp"

namespace lightloom::stability {
namespace {

struct Frames {
  uint32_t size = 4;  ///< [pixels], square
  double mean = 0, width = 0;
  uint32_t bad_frame = 0, bad_bits = 0;  ///< as in shaders/stability/known_frames.comp
};

std::string accumulating_graph(const Frames& frames) {
  const std::string size = std::to_string(frames.size);
  return R"({ "lightloom": 1, "name": "accumulation", "view": { "width": )" + size + R"(, "height": )" + size +
         R"( }, "passes": {
      "frames": { "type": "compute", "shader": "stability/known_frames.comp", "params": { "mean": )" +
         std::to_string(frames.mean) + R"(, "width": )" + std::to_string(frames.width) + R"(, "bad_frame": )" +
         std::to_string(frames.bad_frame) + R"(, "bad_bits": )" + std::to_string(frames.bad_bits) + R"( } },
      "accumulate": { "type": "accumulate", "in": { "radiance": "frames.radiance", "past": "accumulate.accumulation@1" } } },
    "outputs": { "radiance": "accumulate.radiance", "standard_error": "accumulate.standard_error" } })";
}

RunOptions for_frames(uint32_t frames) {
  RunOptions options;
  options.frames = frames;
  return options;
}

scene::Scene any_scene() {
  return make_quad_scene({{{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}}}, {}, look_at({0, 2, 2}, {0, 0, 0}, 0.8f));
}

std::vector<Figure> drift(Lab& lab, uint32_t frames) {
  // A third of it is no number of few bits, and 0.1 not of any.
  const double value = 1000.0 / 3 + 0.1;
  double largest = 0, first = 0;
  lab.visit(accumulating_graph({.mean = value}), any_scene(), for_frames(frames),
            [&](uint32_t frame, const Images& images) {
              const double mean = images.at("radiance").at(3, 3, 0, 0);
              if (frame == 0) first = mean;
              largest = std::max(largest, std::abs(mean / first - 1));
            });
  return {at_most("largest drift of the mean over " + std::to_string(frames) + " frames", largest, 1e-5, "relative")};
}

/// Mean square of what the means over n frames are off, over all pixels.
double squared_error(const image::HostImage& image, double exact) {
  double sum = 0;
  const Extent3 extent = image.desc.extent;
  for (uint32_t y = 0; y < extent.height; ++y)
    for (uint32_t x = 0; x < extent.width; ++x)
      for (uint32_t channel = 0; channel < 3; ++channel) sum += std::pow(image.at(x, y, 0, channel) - exact, 2);
  return sum / (3.0 * extent.width * extent.height);
}

std::vector<Figure> measure_slope(Lab& lab) {
  std::vector<double> x, y;
  lab.visit(accumulating_graph({.size = 48, .mean = 1, .width = 1}), any_scene(), for_frames(10000),
            [&](uint32_t frame, const Images& images) {
              const double n = frame + 1.0;
              if (n < 10 || n < 1.25 * std::exp(x.empty() ? 0 : x.back())) return;
              x.push_back(std::log(n));
              y.push_back(std::log(squared_error(images.at("radiance"), 1)));
            });
  return {at_most("slope of the logarithm of the variance over that of the number of frames, 10 to 10000, less -1",
                  std::abs(slope(x, y) + 1), 0.05),
          at_least("numbers of frames that it is taken over", static_cast<double>(x.size()), 25)};
}

std::vector<Figure> measure_large_mean(Lab& lab) {
  constexpr uint32_t kFrames = 2000, kSize = 16;
  const Images images =
      lab.last_frame(accumulating_graph({.size = kSize, .mean = 1000, .width = 1}), any_scene(), for_frames(kFrames));
  double variance = 0;
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x)
      variance += std::pow(images.at("standard_error").at(x, y, 0, 0), 2) * kFrames / (kSize * kSize);
  return {at_most("variance of noise of width 1 on 1000, against 1/12", std::abs(variance * 12 - 1), 0.01, "relative")};
}

std::vector<Figure> measure_bad_frames(Lab& lab) {
  double bad = 0, off = 0, others = 0;
  for (const uint32_t bits : {1u, 2u, 3u}) {
    const Frames damaged{.mean = 2, .bad_frame = 5, .bad_bits = bits};
    for (const Images& images : lab.frames(accumulating_graph(damaged), any_scene(), for_frames(20))) {
      bad += non_finite(images.at("radiance"));
      off = std::max(off, std::abs(images.at("radiance").at(1, 2, 0, 0) - 2));
    }
    const Images clean = lab.last_frame(accumulating_graph({.mean = 2}), any_scene(), for_frames(20));
    const Images last = lab.last_frame(accumulating_graph(damaged), any_scene(), for_frames(20));
    others += differing_texels(clean.at("radiance"), last.at("radiance")) - 1;
  }
  return {none("values that are not finite in 20 frames", bad), at_most("mean of the other frames", off, 0, "off"),
          at_most("other pixels that change", others, 0)};
}

}  // namespace

void add_accumulation_checks(std::vector<Check>& checks) {
  const CheckGroup add(checks, "accumulation");
  const std::string sums = "sums with the rounding errors beside them: shaders/lib/compensated_sum.glsl";
  add("constant_frames", "10000 frames of a constant", "a running mean in half floats stalls after 45 frames", sums,
      [](Lab& lab) { return drift(lab, 10000); });
  add(
      "constant_frames_1e5", "100000 frames of a constant", "a sum in 32-bit floats is 1e-5 off", sums,
      [](Lab& lab) { return drift(lab, 100000); }, true);
  add("variance_slope", "10000 frames of noise", "noise that repeats, sums that stall: the error stops falling",
      "every frame has random numbers of its own: shaders/lib/random.glsl; " + sums, measure_slope, true);
  add("large_mean", "unit noise on a mean of 1000", "E[x^2] - E[x]^2 gives 171 in place of 1/12",
      "differences from the running mean (Welford): shaders/accumulate.comp, squared_error", measure_large_mean);
  add("bad_frames", "a pixel of one frame is NaN or infinite", "the mean of that pixel is lost for good",
      "a frame that is no number is left out: shaders/accumulate.comp, add_frame", measure_bad_frames);
}

}  // namespace lightloom::stability
