#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/stability/check.hpp"
#include "framework/stability/light_lab.hpp"

namespace lightloom::stability {
namespace {

constexpr uint32_t kX = 15, kY = 14;  ///< the pixel that is spoilt in whole graphs
constexpr uint32_t kBadFrame = 12, kLast = kBadFrame + 14;
constexpr uint32_t kTrailFrame = 3;  ///< the spoilt one of a trail

/// One channel of one image of what `accumulate` left a frame ago.
struct Spoilt {
  const char* image;
  uint32_t part, channel;  ///< as in shaders/stability/inject_accumulation.comp
};

/// Hands on what `accumulate` left, and spoils it on the way.
PassType injection_type(const PassType& accumulate) {
  PassType type;
  type.name = "inject_accumulation";
  type.doc = "Spoils one channel of a pixel of a history.";
  Port past = *accumulate.find_port("past", Direction::in);
  past.extent = ExtentRule::any;
  past.like.clear();
  Port made = *accumulate.find_port("accumulation", Direction::out);
  made.like = "past";
  type.ports = {past, made};
  for (const char* name : {"bad_frame", "part", "channel", "infinite"})
    type.params.push_back({name, ParamType::integer, int64_t{0}, 0.0, 1e6, {}, "", ""});
  type.reads = FrameState::seed;
  type.record = [](PassContext& context) {
    context.dispatch({"stability/inject_accumulation.comp", context.output_extent("accumulation"), {}});
  };
  return type;
}

/// Noise of width 1 around 5, whose history goes through the pass above.
std::string injected_graph(const Spoilt& spoilt, bool infinite, uint32_t bad_frame) {
  return R"({ "lightloom": 1, "name": "spoilt_sums", "view": { "width": 4, "height": 4 }, "passes": {
      "frames": { "type": "compute", "shader": "stability/known_frames.comp",
                  "params": { "mean": 5.0, "width": 1.0, "bad_frame": 0, "bad_bits": 0 } },
      "inject": { "type": "inject_accumulation", "in": { "past": "accumulate.accumulation@1" }, "params": {
                  "bad_frame": )" +
         std::to_string(bad_frame) + R"(, "part": )" + std::to_string(spoilt.part) + R"(, "channel": )" +
         std::to_string(spoilt.channel) + R"(, "infinite": )" + (infinite ? "1" : "0") + R"( } },
      "accumulate": { "type": "accumulate", "in": { "radiance": "frames.radiance", "past": "inject.accumulation" } } },
    "outputs": { "radiance": "accumulate.radiance", "standard_error": "accumulate.standard_error" } })";
}

struct Healing {
  double bad = 0;     ///< values that are not finite, in all frames
  double others = 0;  ///< other pixels that change, in all frames
  double frames = 0;  ///< that the spoilt pixel has after the last one
  double off = 0;     ///< what its mean is off at most, in all frames after
};

Healing healing_of(Lab& lab, const Spoilt& spoilt, bool infinite) {
  const scene::Scene scene = make_quad_scene({{{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}}}, {}, look_at({0, 2, 2}, {}, 0.8f));
  RunOptions options;
  options.frames = kLast + 1;
  const std::vector<Images> damaged = lab.frames(injected_graph(spoilt, infinite, kBadFrame), scene, options);
  const std::vector<Images> clean = lab.frames(injected_graph(spoilt, infinite, 0xFFFF), scene, options);
  Healing healing;
  for (uint32_t frame = 0; frame <= kLast; ++frame)
    for (const char* output : {"radiance", "standard_error"}) {
      const image::HostImage &a = damaged[frame].at(output), &b = clean[frame].at(output);
      healing.bad += non_finite(a);
      healing.others += differing_texels(a, b) - (frame >= kBadFrame ? 1 : 0);
    }
  for (uint32_t frame = kBadFrame; frame <= kLast; ++frame)
    healing.off = std::max(healing.off, std::abs(damaged[frame].at("radiance").at(1, 2, 0, 0) - 5));
  healing.frames = damaged[kLast].at("standard_error").at(1, 2, 0, 3);
  return healing;
}

std::vector<Figure> measure_sums(Lab& lab) {
  PassRegistry registry = lab.registry();
  registry.add(injection_type(*registry.find("accumulate")));
  Lab injecting(lab.device(), registry, lab.shaders());
  std::vector<Figure> frames;
  Healing worst;
  for (const Spoilt& spoilt :
       {Spoilt{"sum", 0, 1}, Spoilt{"number of frames", 0, 3}, Spoilt{"what the sum is short of", 1, 1},
        Spoilt{"number of lit frames", 1, 3}, Spoilt{"spread", 2, 1}, Spoilt{"number of frames without an error", 2, 3},
        Spoilt{"what the spread is short of", 3, 1}})
    for (const bool infinite : {false, true}) {
      const Healing healing = healing_of(injecting, spoilt, infinite);
      worst.bad += healing.bad;
      worst.others += std::abs(healing.others);
      worst.off = std::max(worst.off, healing.off);
      frames.push_back(equal(std::string("frames in the pixel's mean, the spoilt one the first: ") +
                                 (infinite ? "infinite " : "NaN ") + spoilt.image,
                             healing.frames, kLast + 1 - kBadFrame));
    }
  std::vector<Figure> figures = {none("values that are not finite in 27 frames", worst.bad),
                                 none("other pixels that change", worst.others),
                                 at_most("mean of the frames since, off 5", worst.off, 0.5)};
  figures.insert(figures.end(), frames.begin(), frames.end());
  return figures;
}

/// The graph that ships, with histories that keep images of the G-buffer as they are: packed ones hold no NaN.
std::string unpacked_trails(const std::string& text) {
  nlohmann::ordered_json graph = nlohmann::ordered_json::parse(text);
  for (auto& pass : graph["passes"]) {
    if (pass["type"] != "temporal_accumulate_packed") continue;
    pass["type"] = "temporal_accumulate";
    pass["in"].erase("trail_point");
    for (const char* part : {"position", "normal", "id"})
      pass["in"]["trail_" + std::string(part)] = "trace_surface.surface." + std::string(part) + "@1..9";
  }
  return graph.dump();
}

/// Such a graph, with a pixel spoilt in one frame of what it remembers of where surfaces were: `part` of the
/// G-buffer on its way to histories alone.
std::string spoilt_trail(const std::string& text, const std::string& part, bool infinite) {
  nlohmann::ordered_json graph = nlohmann::ordered_json::parse(text);
  const std::string source = "trace_surface.surface." + part;
  for (auto& pass : graph["passes"]) {
    if (!pass.contains("in")) continue;
    for (auto& edge : pass["in"]) {
      const std::string name = edge.get<std::string>();
      if (name.rfind(source + "@", 0) == 0) edge = "spoil.radiance" + name.substr(source.size());
    }
  }
  graph["passes"]["spoil"] = {
      {"type", "compute"},
      {"shader", "stability/inject.comp"},
      {"in", {{"radiance", source}}},
      {"params", {{"x", kX}, {"y", kY}, {"bad_frame", kTrailFrame}, {"infinite", infinite ? 1 : 0}}}};
  return graph.dump();
}

std::vector<Figure> measure_trails(Lab& lab) {
  const scene::Scene scene = room_of_all_lights();
  const std::string text = unpacked_trails(lab.shipped_graph("lightloom"));
  RunOptions options;
  options.frames = kTrailFrame + 11;
  options.link.view = options.link.trace = {32, 24};
  options.link.sets = {{"resolution", "32"}};
  options.capture = {"temporal_diffuse.radiance"};
  std::vector<Figure> figures;
  const auto differing = [](const Images& a, const Images& b, const char* name) {
    return differing_texels(a.at(name), b.at(name));
  };
  const std::vector<Images> clean = lab.frames(text, scene, options);
  for (const char* part : {"position", "normal"})
    for (const bool infinite : {false, true}) {
      const std::vector<Images> damaged = lab.frames(spoilt_trail(text, part, infinite), scene, options);
      double bad = 0, next = 0, most = 0;
      for (uint32_t frame = 0; frame < options.frames; ++frame) {
        bad += non_finite(damaged[frame].at("radiance"));
        most = std::max(most, differing(damaged[frame], clean[frame], "temporal_diffuse.radiance"));
      }
      next = differing(damaged[kTrailFrame + 1], clean[kTrailFrame + 1], "temporal_diffuse.radiance");
      const std::string which = std::string(part) + (infinite ? ", infinity: " : ", NaN: ");
      figures.push_back(none(which + "values that are not finite", bad));
      figures.push_back(equal(which + "pixels whose mean over frames changes in the next frame", next, 1));
      figures.push_back(at_most(which + "the same, most in any frame", most, 1));
      figures.push_back(none(which + "pixels of the picture that differ ten frames later",
                             differing(damaged[kTrailFrame + 10], clean[kTrailFrame + 10], "radiance")));
    }
  return figures;
}

}  // namespace

void add_history_checks(std::vector<Check>& checks) {
  const CheckGroup add(checks, "injected NaN");
  add("spoilt_sums", "what accumulation left a frame ago is NaN or infinite in one channel of a pixel",
      "every later frame is left out because of it: the pixel never heals",
      "such a pixel starts anew: shaders/accumulate.comp, is_sound", measure_sums);
  add("spoilt_trails", "a position or a normal of an earlier frame is NaN or infinite",
      "a comparison that is false for NaN takes the pixel for the same surface",
      "tests that only numbers pass: shaders/lib/temporal.glsl, find_in_frame", measure_trails);
}

}  // namespace lightloom::stability
