// Light of the environment: next event estimation, scattered rays and both together find the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include "framework/scene/images.hpp"
#include "tests/passes/light_scenes.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::test {
namespace {

using Radiance = std::function<float(uint32_t, uint32_t)>;

class LightEnvironment : public DeviceTest {};

/// A 64 x 32 image; colours differ, so that a mix-up of channels shows.
void surround(scene::Scene& scene, const Radiance& radiance) {
  scene.environment.radiance = glm::vec3(1.5f);
  scene.environment.width = 64;
  scene.environment.height = 32;
  scene.environment.rgb.clear();
  for (uint32_t y = 0; y < 32; ++y)
    for (uint32_t x = 0; x < 64; ++x)
      for (int channel = 0; channel < 3; ++channel)
        scene.environment.rgb.push_back(radiance(x, y) * (1 + 0.3f * static_cast<float>(channel)));
  scene.features.environment = scene.features.environment_image = true;
}

/// Bright window in the sky, darker elsewhere, nearly black below.
float window(uint32_t x, uint32_t y) {
  if (x >= 20 && x < 34 && y >= 4 && y < 11) return 12;
  return y < 16 ? 0.5f : 0.02f;
}

scene::Material glossy(float alpha) {
  scene::Material material;
  material.base_color = glm::vec4(0.8f, 0.6f, 0.4f, 1);
  material.metallic = 0.5f;
  material.roughness = std::sqrt(alpha);
  return material;
}

/// A floor with an upright wall on it.
scene::Scene floor_and_wall(const scene::Material& floor, scene::Material wall) {
  wall.double_sided = true;
  const QuadSpec upright{{-0.3f, 0, 0.8f}, {0, 0, -1.6f}, {0, 1, 0}, 1};
  return make_quad_scene({square_floor(2), upright}, {floor, wall}, look_at({2.2f, 2, 1.6f}, {0, 0.2f, 0}, 0.9f));
}

std::vector<Images> trace_with(const scene::Scene& scene, const std::string& params, uint32_t frames,
                               uint32_t seed = 1) {
  return trace_frames(scene,
                      {.params = R"("bounces": 2, )" + params, .resolution = 24, .frames = frames, .seed = seed});
}

/// Compares means of 8 x 8 pixels by their standard errors.
void expect_same_light(const std::vector<Images>& a, const std::vector<Images>& b, const std::string& what) {
  for (uint32_t channel = 0; channel < 3; ++channel) {
    const std::vector<SampleMean> first = block_estimates(a, channel, 8), second = block_estimates(b, channel, 8);
    double sum = 0, count = 0;
    for (size_t k = 0; k < first.size(); ++k) {
      if (!std::isfinite(first[k].mean()) || !(first[k].error() > 0)) continue;  // background
      const double z = (first[k].mean() - second[k].mean()) / std::hypot(first[k].error(), second[k].error());
      EXPECT_LT(std::abs(z), 5) << what << ", block " << k << " channel " << channel;
      sum += std::abs(z);
      ++count;
    }
    ASSERT_GE(count, 10);
    EXPECT_LT(sum / count, 1.3) << what << ", channel " << channel;
    const SampleMean all = frame_estimate(a, channel), other = frame_estimate(b, channel);
    EXPECT_LT(std::abs(all.mean() - other.mean()), 3 * std::hypot(all.error(), other.error())) << what;
  }
}

TEST_F(LightEnvironment, AllStrategiesFindTheSameLight) {
  scene::Scene scene = floor_and_wall(glossy(1), glossy(0.25f));
  surround(scene, window);
  const std::vector<Images> rays = trace_with(scene, R"("paths": 24, "strategy": "bsdf")", 24, 11);
  expect_same_light(rays, trace_with(scene, R"("paths": 16, "strategy": "nee")", 24, 12), "nee");
  expect_same_light(rays, trace_with(scene, R"("paths": 8, "heuristic": "balance")", 24, 13), "balance");
  expect_same_light(rays, trace_with(scene, R"("paths": 8, "heuristic": "power")", 24, 14), "power");
  expect_same_light(rays, trace_with(scene, R"("paths": 24, "environment_sampling": "off")", 24, 15), "off");
}

TEST_F(LightEnvironment, StrategiesAgreeUnderAPhotographedSky) {
  const std::filesystem::path file = source_dir() / "../shared/scenes/env/dresden_square_1k.hdr";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is missing";
  scene::Scene scene = floor_and_wall(glossy(0.5f), glossy(0.5f));
  scene::load_environment(file, "the test", scene.environment);
  // The sun itself is hit so rarely by chance that standard errors would tell nothing.
  for (float& value : scene.environment.rgb) value = std::min(value, 30.0f);
  scene.environment.radiance = glm::vec3(1);
  scene.features.environment = scene.features.environment_image = true;
  const std::vector<Images> rays = trace_with(scene, R"("paths": 48, "strategy": "bsdf")", 48, 21);
  expect_same_light(rays, trace_with(scene, R"("paths": 8, "strategy": "nee")", 48, 22), "nee");
  expect_same_light(rays, trace_with(scene, R"("paths": 8)", 48, 23), "balance");
}

TEST_F(LightEnvironment, SamplingASmallBrightSpotTakesTheNoiseAway) {
  scene::Scene scene = floor_and_wall(lambertian(glm::vec3(0.5f)), glossy(0.5f));
  surround(scene, [](uint32_t x, uint32_t y) { return x == 30 && y == 6 ? 3000.0f : 0.3f; });
  const std::vector<Images> sampled = trace_with(scene, R"("paths": 4)", 12);
  const std::vector<Images> found = trace_with(scene, R"("paths": 4, "environment_sampling": "off")", 12);
  double with = 0, without = 0;
  for (const SampleMean& block : block_estimates(sampled, 1, 4))
    if (block.count() > 0 && std::isfinite(block.variance())) with += block.variance();
  for (const SampleMean& block : block_estimates(found, 1, 4))
    if (block.count() > 0 && std::isfinite(block.variance())) without += block.variance();
  EXPECT_GT(with, 0);
  EXPECT_GT(without / with, 30);
}

TEST_F(LightEnvironment, MirrorsSeeAllOfItWhateverTheStrategy) {
  scene::Material mirror;
  mirror.base_color = glm::vec4(0.9f, 0.9f, 0.9f, 1);
  mirror.roughness = 0;
  scene::Scene scene = make_quad_scene({square_floor(2)}, {mirror}, look_at({2.2f, 2, 1.6f}, {0, 0, 0}, 0.9f));
  surround(scene, window);
  const auto bits = [&](const char* strategy) {
    return trace_with(scene, R"("paths": 1, "strategy": ")" + std::string(strategy) + "\"", 1)
        .front()
        .at("radiance")
        .texels;
  };
  const auto expected = bits("bsdf");
  EXPECT_EQ(bits("mis"), expected);
  EXPECT_EQ(bits("nee"), expected);
}

TEST_F(LightEnvironment, AConstantOneIsLeftToScatteredRaysUnlessTheyMayNot) {
  scene::Scene scene = floor_and_wall(glossy(0.5f), glossy(0.5f));
  scene.environment.radiance = glm::vec3(1, 2, 3);
  scene.features.environment = true;
  const std::vector<Images> rays = trace_with(scene, R"("paths": 8, "strategy": "bsdf")", 16);
  const std::vector<Images> both = trace_with(scene, R"("paths": 8)", 16);
  EXPECT_EQ(rays.front().at("radiance").texels, both.front().at("radiance").texels);
  expect_same_light(rays, trace_with(scene, R"("paths": 32, "strategy": "nee")", 16, 5), "nee");
  scene.features = {true, true, true, true, true, true, true, true, true, true, true, true};
  EXPECT_EQ(trace_with(scene, R"("paths": 8)", 1).front().at("radiance").texels, both.front().at("radiance").texels);
}

}  // namespace
}  // namespace lightloom::test
