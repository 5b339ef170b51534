#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/stability/check.hpp"
#include "framework/stability/light_lab.hpp"

namespace lightloom::stability {
namespace {

constexpr uint32_t kBadFrame = 12, kLast = kBadFrame + 11, kX = 22, kY = 20, kWidth = 48, kHeight = 36;

/// `text` with a pass between the tracer and all that reads it, which spoils a pixel of one frame.
std::string spoilt(const std::string& text, bool infinite, uint32_t frame) {
  nlohmann::ordered_json graph = nlohmann::ordered_json::parse(text);
  const std::vector<std::string> ports = {"radiance", "diffuse", "specular"};
  std::vector<std::string> read;
  for (auto& pass : graph["passes"]) {
    if (!pass.contains("in")) continue;
    for (auto& edge : pass["in"]) {
      const std::string source = edge.get<std::string>();
      for (const std::string& port : ports) {
        const std::string full = "trace." + port;
        if (source != full && source.rfind(full + "@", 0) != 0) continue;
        edge = "spoil_" + port + ".radiance" + source.substr(full.size());
        if (std::find(read.begin(), read.end(), port) == read.end()) read.push_back(port);
      }
    }
  }
  for (const std::string& port : read)
    graph["passes"]["spoil_" + port] = {
        {"type", "compute"},
        {"shader", "stability/inject.comp"},
        {"in", {{"radiance", "trace." + port}}},
        {"params", {{"x", kX}, {"y", kY}, {"bad_frame", frame}, {"infinite", infinite ? 1 : 0}}}};
  return graph.dump();
}

struct Damage {
  double bad = 0, first_area = 0, last_area = 0, reach = 0;
};

/// Frames after the spoilt one against the same without it.
Damage damage_of(Lab& lab, const std::string& graph, bool infinite) {
  RunOptions options;
  options.frames = kLast + 1;
  options.link.view = options.link.trace = {kWidth, kHeight};
  options.link.sets = {{"resolution", "32"}};
  const std::string text = lab.shipped_graph(graph);
  const scene::Scene scene = room_of_all_lights();
  const std::vector<Images> damaged = lab.frames(spoilt(text, infinite, kBadFrame), scene, options);
  const std::vector<Images> clean = lab.frames(spoilt(text, infinite, 0xFFFF), scene, options);
  Damage damage;
  for (const Images& images : damaged) damage.bad += non_finite(images.at("radiance"));
  const image::HostImage &a = damaged[kBadFrame].at("radiance"), &b = clean[kBadFrame].at("radiance");
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x) {
      if (a.at(x, y, 0, 0) == b.at(x, y, 0, 0)) continue;
      ++damage.first_area;
      damage.reach = std::max({damage.reach, std::abs(double(x) - kX), std::abs(double(y) - kY)});
    }
  damage.last_area = differing_texels(damaged[kBadFrame + 10].at("radiance"), clean[kBadFrame + 10].at("radiance"));
  return damage;
}

std::vector<Figure> measure_history(Lab& lab) {
  std::vector<Figure> figures;
  for (const char* graph : {"lightloom", "paper"})
    for (const bool infinite : {false, true}) {
      if (infinite && std::string(graph) == "paper") continue;  // the same passes
      const Damage damage = damage_of(lab, graph, infinite);
      const std::string which = std::string(graph) + (infinite ? ", infinity: " : ", NaN: ");
      figures.push_back(none(which + "values that are not finite", damage.bad));
      // Two filters along the surface and two boxes of 4 pixels each, and what upsampling blends.
      figures.push_back(at_most(which + "pixels that it reaches to in its frame", damage.reach, 24, "pixels"));
      figures.push_back(at_least(which + "pixels that it changes in its frame", damage.first_area, 1));
      figures.push_back(none(which + "pixels that differ ten frames later", damage.last_area));
    }
  return figures;
}

std::vector<Figure> measure_environment(Lab& lab) {
  std::vector<Figure> figures;
  scene::Scene black_texel = room_of_all_lights();
  for (size_t channel = 0; channel < 3; ++channel) black_texel.environment.rgb[21 * 3 + channel] = 0;
  for (const char* graph : {"lightloom", "paper", "reference"}) {
    const image::HostImage expected = render_shipped(lab, graph, black_texel, 2);
    double bad = 0, differing = 0;
    for (const float value : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                              -std::numeric_limits<float>::infinity(), -3.0f}) {
      scene::Scene scene = black_texel;
      for (size_t channel = 0; channel < 3; ++channel) scene.environment.rgb[21 * 3 + channel] = value;
      if (std::string(graph) == "paper" && !std::isnan(value)) continue;  // the same table and image
      const image::HostImage image = render_shipped(lab, graph, scene, 2);
      bad += non_finite(image);
      differing += differing_texels(image, expected);
    }
    figures.push_back(none(std::string(graph) + ", values that are not finite", bad));
    figures.push_back(none(std::string(graph) + ", pixels that differ from those of a black texel", differing));
  }
  return figures;
}

}  // namespace

void add_injection_checks(std::vector<Check>& checks) {
  checks.push_back({.name = "spoilt_history",
                    .group = "injected NaN",
                    .extreme = "a pixel of one frame's light is NaN or infinite on its way to filters and history",
                    .danger = "the filters spread it, the history keeps it: white areas that never go",
                    .guard = "bit tests before every sum: shaders/lib/temporal.glsl, add_frame; "
                             "shaders/lib/neighbour.glsl, belongs",
                    .measure = measure_history});
  checks.push_back({.name = "spoilt_environment",
                    .group = "injected NaN",
                    .extreme = "a texel of the sky is NaN, infinite or negative",
                    .danger = "a cumulative distribution of NaN, filtering that spreads it",
                    .guard = "such texels count as 0 in table and image: framework/scene/environment_sampler.hpp, "
                             "environment_texel; files that hold one are refused",
                    .measure = measure_environment});
}

}  // namespace lightloom::stability
