// Reservoirs of light samples (light_reservoirs, reuse_reservoirs): the same mean as without, less noise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "framework/base/error.hpp"
#include "tests/passes/estimator_support.hpp"
#include "tests/passes/light_scenes.hpp"
#include "tests/passes/moving_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

class LightReservoirs : public DeviceTest {};

constexpr uint32_t kSize = 32;
constexpr const char* kTracer = R"("bounces": 0, "nee": "voxel_faces")";
const std::string kLists = R"("surface": "gather.surface", "voxels": "voxelize.voxels", "faces": "faces.faces")";
const std::string kPast = R"(, "past": "reuse.reservoir@1", "past_surface": "gather.surface@1")";

struct Chain {
  std::string past = kPast;      ///< more inputs of light_reservoirs, as JSON members with a comma ahead
  std::string reservoirs = "";   ///< params of light_reservoirs, as JSON members
  std::string reuse = "";        ///< of reuse_reservoirs
  std::string tracer = kTracer;  ///< of voxel_path_trace
  bool connected = true;         ///< does the tracer read the reservoirs?
};

std::string chain_graph(const Chain& chain) {
  const std::string nodes =
      R"("faces": { "type": "emissive_faces", "in": { "voxels": "voxelize.voxels" } },
         "moved": { "type": "moved_voxels", "in": { "voxels": "voxelize.voxels" } },
         "reservoirs": { "type": "light_reservoirs", "in": { )" +
      kLists + chain.past + R"( }, "params": { )" + chain.reservoirs + R"( } },
         "reuse": { "type": "reuse_reservoirs", "in": { )" +
      kLists + R"(, "reservoir": "reservoirs.reservoir" }, "params": { )" + chain.reuse + R"( } }, )";
  const std::string inputs =
      std::string(R"(, "faces": "faces.faces")") + (chain.connected ? R"(, "reservoir": "reuse.reservoir")" : "");
  const bool says_draws = chain.tracer.find("reservoir_draws") != std::string::npos;
  const std::string tracer = chain.tracer + (chain.connected && !says_draws ? R"(, "reservoir_draws": 1)" : "");
  return graph_text(kSize, kSize, kSize, kSize, nodes + trace_passes(32, tracer, inputs),
                    chain.connected ? R"("radiance": "trace.radiance", "reservoir": "reuse.reservoir")"
                                    : R"("radiance": "trace.radiance")");
}

/// `count` means over as many frames each, after the first eight: frames share samples, so that only long stretches of
/// them are independent.
std::vector<Images> stretches(const Chain& chain, const scene::Scene& scene, uint32_t count, uint32_t frames) {
  constexpr uint32_t kFirst = 8;
  std::vector<Images> means(count);
  GraphRunOptions options;
  options.frames = kFirst + count * frames;
  visit_frames(chain_graph(chain), scene, options, [&](uint32_t frame, Images images) {
    if (frame < kFirst) return;
    image::HostImage& mean = means[(frame - kFirst) / frames]["radiance"];
    const image::HostImage& image = images.at("radiance");
    if (mean.texels.empty()) {
      mean.desc = image.desc;
      mean.texels.resize(image.texels.size());
    }
    auto* sum = reinterpret_cast<float*>(mean.texels.data());
    for (uint32_t i = 0; i < kSize * kSize * 4; ++i)
      sum[i] += static_cast<float>(image.at(i / 4 % kSize, i / 4 / kSize, 0, i % 4) / frames);
  });
  return means;
}

constexpr uint32_t kStretches = 16;

std::vector<Images> expected_means(const scene::Scene& scene) {
  return stretches({.tracer = R"("paths": 32, "bounces": 0, "nee": "voxel_faces")", .connected = false}, scene,
                   kStretches, 1);
}

void expect_mean(const std::vector<Images>& expected, const Chain& chain, const scene::Scene& scene,
                 const std::string& what) {
  const std::vector<Images> got = stretches(chain, scene, kStretches, 8);
  for (const uint32_t channel : {0u, 2u})
    expect_agreement(image_estimate(got, "radiance", channel), image_estimate(expected, "radiance", channel), what);
}

scene::Material lamp(const glm::vec3& emission, bool double_sided = false) {
  scene::Material material = lambertian(glm::vec3(0.1f));
  material.emission = emission;
  material.double_sided = double_sided;
  return material;
}

/// A floor, a wall and a board that hides some of forty small lamps of four kinds from some of it.
scene::Scene many_lamps() {
  std::vector<QuadSpec> quads = {{{-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 0},
                                 {{-2, 0, -2}, {4, 0, 0}, {0, 2.5f, 0}, 1},
                                 {{-0.8f, 0.7f, 0.8f}, {1.4f, 0, 0}, {0, 0, -1.3f}, 1}};
  for (uint32_t k = 0; k < 40; ++k) {
    const auto a = static_cast<float>(k * 37 % 40) / 40, b = static_cast<float>(k * 23 % 40) / 40;
    const glm::vec3 corner(-1.9f + 3.6f * a, 0.4f + 1.8f * b, -1.8f + 3.4f * static_cast<float>(k) / 40);
    quads.push_back({corner, {0, 0, 0.15f}, {k % 3 == 0 ? -0.15f : 0.15f, 0, 0}, 2 + k % 4});
  }
  return make_quad_scene(quads,
                         {lambertian(glm::vec3(0.6f)), glossy_floor(), lamp({9, 3, 1}), lamp({1, 2, 8}, true),
                          lamp({40, 40, 30}), lamp({2, 9, 2})},
                         look_at({-1.2f, 1.6f, 2.6f}, {0, 0.3f, 0}, 0.9f));
}

/// Pixels that have little in common: every pixel of the picture near by is reused, whatever it shows.
constexpr const char* kAnyNeighbour = R"("radius": 10, "normal_threshold": -1, "depth_tolerance": 1000)";

TEST_F(LightReservoirs, HaveTheMeanOfTheTracerWithoutThem) {
  const scene::Scene scene = many_lamps();
  const std::vector<Images> expected = expected_means(scene);
  expect_mean(expected, {.past = "", .reuse = kAnyNeighbour}, scene, "any neighbours");
  expect_mean(expected, {.reservoirs = R"("history": 3, "candidates": 3)", .reuse = R"("neighbours": 0)"}, scene,
              "past");
  const std::string draws = R"("reservoir_draws": 16)";
  expect_mean(expected,
              {.reservoirs = R"("history": 2, )" + draws,
               .reuse = kAnyNeighbour + (", " + draws),
               .tracer = kTracer + (", " + draws)},
              scene, "all, with a larger share of the light");
  expect_mean(expected, {.past = "", .tracer = kTracer + std::string(R"(, "heuristic": "power", "paths": 2)")}, scene,
              "another target, and several paths to a sample");
}

/// Mean over pixels and channels of the variance over frames.
double variance_over_frames(const Chain& chain) {
  std::vector<SampleMean> values(size_t{3} * kSize * kSize);
  GraphRunOptions options;
  options.frames = 72;
  visit_frames(chain_graph(chain), many_lamps(), options, [&](uint32_t frame, const Images& images) {
    for (uint32_t i = 0; i < values.size() && frame >= 8; ++i)
      values[i].add(images.at("radiance").at(i / 3 % kSize, i / 3 / kSize, 0, i % 3));
  });
  double sum = 0;
  for (const SampleMean& value : values) sum += value.variance();
  return sum / static_cast<double>(values.size());
}

TEST_F(LightReservoirs, HaveLessNoiseForAsManyRays) {
  const std::string draws = R"("reservoir_draws": 16)";
  const double without = variance_over_frames({.connected = false});
  const double chosen = variance_over_frames(
      {.past = "", .reservoirs = draws, .reuse = R"("neighbours": 0, )" + draws, .tracer = kTracer + (", " + draws)});
  const double reused = variance_over_frames({.reservoirs = draws, .reuse = draws, .tracer = kTracer + (", " + draws)});
  RecordProperty("chosen", std::to_string(chosen / without));
  RecordProperty("reused", std::to_string(reused / without));
  EXPECT_LT(chosen, 0.6 * without);
  EXPECT_LT(reused, 0.3 * without);
}

float count_of(const image::HostImage& reservoir, uint32_t x, uint32_t y) {
  float count = 0;
  std::memcpy(&count, reservoir.texels.data() + (size_t{y} * kSize + x) * 16 + 12, sizeof(count));
  return count;
}

TEST_F(LightReservoirs, CountNoMoreThanTheHistoryAllowsInEveryRunTheSame) {
  GraphRunOptions options;
  options.frames = 8;
  const std::string graph = chain_graph({.reservoirs = R"("history": 5)", .reuse = R"("neighbours": 2)"});
  const std::vector<Images> first = run_graph(graph, many_lamps(), options);
  const std::vector<Images> second = run_graph(graph, many_lamps(), options);
  float largest = 0;
  for (size_t frame = 0; frame < first.size(); ++frame) {
    const image::HostImage& reservoir = first[frame].at("reservoir");
    for (uint32_t y = 0; y < kSize; ++y)
      for (uint32_t x = 0; x < kSize; ++x) largest = std::max(largest, count_of(reservoir, x, y));
    EXPECT_TRUE(reservoir.texels == second[frame].at("reservoir").texels) << frame;
    EXPECT_TRUE(first[frame].at("radiance").texels == second[frame].at("radiance").texels) << frame;
  }
  EXPECT_EQ(largest, 3 * (1 + 5)) << "a pixel and two neighbours, of this frame and the past each";
}

scene::Scene floor_below(const scene::Material& above) {
  return make_quad_scene({square_floor(2), {{-0.3f, 1.2f, -0.3f}, {0.6f, 0, 0}, {0, 0, 0.6f}, 1}},
                         {lambertian(glm::vec3(0.5f)), above}, look_at({0, 1, 2.5f}, {0, 0.2f, 0}, 0.8f));
}

TEST_F(LightReservoirs, OfLampsWithoutLightChangeNothing) {
  scene::Scene dark = floor_below(lambertian(glm::vec3(0)));
  dark.features.emissive = true;
  dark.environment.radiance = {1, 0.5f, 0.25f};
  dark.features.environment = true;
  const std::vector<Images> with = run_graph(chain_graph({}), dark, {});
  const std::vector<Images> without = run_graph(chain_graph({.connected = false}), dark, {});
  EXPECT_TRUE(with.back().at("radiance").texels == without.back().at("radiance").texels);
}

TEST_F(LightReservoirs, ThatAPassLeavesEmptyAreFilledByTheTracer) {
  GraphRunOptions options;
  const std::vector<Images> without = run_graph(chain_graph({.connected = false}), many_lamps(), options);
  options.link.disables = {"reservoirs", "reuse"};
  const std::vector<Images> off = run_graph(chain_graph({}), many_lamps(), options);
  EXPECT_TRUE(off.back().at("radiance").texels == without.back().at("radiance").texels);
}

TEST_F(LightReservoirs, RefuseWhatDoesNotGoTogether) {
  EXPECT_THROW(run_graph(chain_graph({.tracer = R"("nee": "hints")"}), many_lamps(), {}), Error);
  EXPECT_THROW(run_graph(chain_graph({.past = R"(, "past": "reuse.reservoir@1")"}), many_lamps(), {}), Error);
}

/// A lamp that is elsewhere in every frame, over a floor that it does not touch, and one that rests.
scene::Scene moving_lamp() {
  constexpr int kFrames = 8;
  std::vector<Placement> placements;
  for (int frame = 0; frame < kFrames; ++frame)
    placements.push_back({{-0.9f + 0.25f * static_cast<float>(frame), 0.6f, 0.3f}, {1, 0, 0, 0}, 1});
  return with_moving(floor_below(lamp({2, 2, 6})),
                     {{cube_triangles(0.12f, glm::mat3(1)), lamp({30, 10, 5}, true), placements}});
}

TEST_F(LightReservoirs, FollowLampsThatMove) {
  const scene::Scene scene = moving_lamp();
  GraphRunOptions options;
  options.frames = 4;
  const Chain without{.tracer = R"("paths": 64, "bounces": 0, "nee": "voxel_faces")", .connected = false};
  const Chain with{.past = kPast + R"(, "moved": "moved.moved")", .reuse = R"("neighbours": 1)"};
  const double expected = frame_estimate({run_graph(chain_graph(without), scene, options).back()}, 0).mean();
  SampleMean got;
  for (options.seed = 1; options.seed <= 3; ++options.seed)
    got.add(frame_estimate({run_graph(chain_graph(with), scene, options).back()}, 0).mean());
  // Were the lamp's new faces weighed as if they had been there before, most of its light would be missing.
  EXPECT_NEAR(got.mean(), expected, 0.1 * expected);
  EXPECT_LT(got.error(), 0.05 * expected);
}

}  // namespace
}  // namespace lightloom::test
