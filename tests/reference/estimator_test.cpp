// What any estimator must keep: strategies agree, errors are as large as it says, threads do not matter.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "framework/base/error.hpp"
#include "tests/support/tracing.hpp"

namespace lightloom::test {
namespace {

/// Glossy and matte surfaces under every kind of light, with things in the way. `small`: lights that rays hardly ever
/// meet.
scene::Scene mixed_scene(bool small, float roughness = 0.5f) {
  SceneBuilder builder;
  scene::Material glossy = matte(glm::vec3(0.6f, 0.5f, 0.3f));
  glossy.specular_factor = 1;
  glossy.roughness = roughness;
  scene::Material brushed = white_metal(0.9f * roughness);
  brushed.anisotropy_strength = roughness > 0.2f ? 0.6f : 0;
  brushed.anisotropy_rotation = 0.7f;
  scene::Material lamp = matte(glm::vec3(0.2f), glm::vec3(4, 3, 2));
  lamp.double_sided = true;
  builder.quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, builder.material(glossy));
  builder.quad({-2, 0, -2}, {4, 0, 0}, {0, 3, 0}, builder.material(brushed));
  const float size = small ? 0.2f : 1.2f;
  builder.quad({-0.8f, 1.5f, -0.5f}, {size, 0.3f, 0}, {0, 0.1f, size}, builder.material(lamp));
  builder.quad({0.4f, 0, 0.8f}, {0.8f, 0, 0.2f}, {0, 0.9f, 0}, builder.material(matte(glm::vec3(0.8f))));
  builder.scene.sun = scene::Sun{glm::normalize(glm::vec3(0.3f, -1, -0.4f)), glm::vec3(2), small ? 0.01f : 0.35f};
  scene::Environment& sky = builder.scene.environment;
  sky.radiance = glm::vec3(0.5f);
  sky.width = 8;
  sky.height = 4;
  for (uint32_t i = 0; i < 32; ++i)
    for (const float channel : {1.0f, 1.5f, 2.5f}) sky.rgb.push_back(i == 5 ? 6 : i % 3 == 0 ? 0 : channel);
  return builder.finish(perspective({0.5f, 1.6f, 4}, {0, 0.7f, 0}, 0.9f, {0, 1, 0}));
}

reference::ImageSettings settings(uint32_t paths, uint32_t seed,
                                  reference::Strategy strategy = reference::Strategy::mis) {
  reference::ImageSettings result;
  result.width = 12;
  result.height = 9;
  result.paths = paths;
  result.seed = seed;
  result.path.bounces = 2;
  result.path.strategy = strategy;
  return result;
}

/// Mean of all channels over the image, and its standard error from that of the pixels.
Estimate whole(const Traced& traced) {
  double sum = 0, squares = 0;
  for (const reference::TracedPixel& pixel : traced.pixels)
    for (int channel = 0; channel < 3; ++channel) {
      sum += static_cast<double>(pixel.outgoing[channel]);
      squares += std::pow(static_cast<double>(pixel.standard_error[channel]), 2);
    }
  // Channels of a pixel are correlated: in the worst case the errors add up.
  const double count = static_cast<double>(traced.pixels.size()) * 3;
  return {sum / count, std::sqrt(3 * squares) / count};
}

TEST(ReferenceEstimator, StrategiesAgree) {
  const scene::Scene scene = mixed_scene(false);
  const Traced both = trace(scene, settings(3000, 1));
  const Traced lights = trace(scene, settings(6000, 2, reference::Strategy::nee));
  const Traced rays = trace(scene, settings(12000, 3, reference::Strategy::bsdf));
  double squares = 0;
  uint32_t count = 0, far = 0;
  for (const Traced* other : {&lights, &rays}) {
    const Estimate a = whole(both), b = whole(*other);
    EXPECT_LT(std::abs(a.mean - b.mean), 4 * std::hypot(a.error, b.error)) << a.mean << " and " << b.mean;
    for (size_t i = 0; i < both.pixels.size(); ++i) {
      const double error = std::hypot(static_cast<double>(both.pixels[i].standard_error.g),
                                      static_cast<double>(other->pixels[i].standard_error.g));
      if (!(error > 0)) continue;
      const double z = static_cast<double>(both.pixels[i].outgoing.g - other->pixels[i].outgoing.g) / error;
      squares += z * z;
      far += std::abs(z) > 4 ? 1 : 0;
      ++count;
    }
  }
  ASSERT_GT(count, 150U);
  EXPECT_NEAR(squares / count, 1, 5 * std::sqrt(2.0 / count));
  EXPECT_LE(far, count / 100);
}

TEST(ReferenceEstimator, StrategiesAgreeInAllForms) {
  const scene::Scene scene = mixed_scene(false);
  for (const auto ward : {reference::WardForm::ward_1992, reference::WardForm::dur}) {
    reference::ImageSettings by_lights = settings(2000, 4, reference::Strategy::nee);
    reference::ImageSettings by_rays = settings(4000, 5, reference::Strategy::bsdf);
    by_lights.path.ward = by_rays.path.ward = ward;
    const Estimate a = whole(trace(scene, by_lights)), b = whole(trace(scene, by_rays));
    EXPECT_LT(std::abs(a.mean - b.mean), 4 * std::hypot(a.error, b.error)) << a.mean << " and " << b.mean;
  }
}

TEST(ReferenceEstimator, StrategiesAgreeOnNarrowLobesAndMirrors) {
  for (const float roughness : {0.1f, 0.04f, 0.0f}) {
    const scene::Scene scene = mixed_scene(false, roughness);
    const Estimate a = whole(trace(scene, settings(3000, 6)));
    const Estimate b = whole(trace(scene, settings(8000, 7, reference::Strategy::bsdf)));
    EXPECT_LT(std::abs(a.mean - b.mean), 4 * std::hypot(a.error, b.error))
        << roughness << ": " << a.mean << " and " << b.mean;
    EXPECT_LT(a.error, 0.01 * a.mean) << roughness;
  }
}

TEST(ReferenceEstimator, SharingIsNoNoisierThanEither) {
  const scene::Scene scene = mixed_scene(true);
  const double both = whole(trace(scene, settings(400, 1))).error;
  EXPECT_LT(both, 1.1 * whole(trace(scene, settings(400, 1, reference::Strategy::nee))).error);
  EXPECT_LT(both, 0.5 * whole(trace(scene, settings(400, 1, reference::Strategy::bsdf))).error);
}

TEST(ReferenceEstimator, ErrorsAreAsLargeAsTheySay) {
  const scene::Scene scene = mixed_scene(true);
  const Traced truth = trace(scene, settings(15000, 100));
  double squares = 0, outside = 0, count = 0;
  for (uint32_t seed = 0; seed < 6; ++seed) {
    const Traced traced = trace(scene, settings(500, seed));
    for (size_t i = 0; i < traced.pixels.size(); ++i) {
      if (!(traced.pixels[i].standard_error.g > 0)) continue;
      const double error = std::hypot(static_cast<double>(traced.pixels[i].standard_error.g),
                                      static_cast<double>(truth.pixels[i].standard_error.g));
      const double z = static_cast<double>(traced.pixels[i].outgoing.g - truth.pixels[i].outgoing.g) / error;
      squares += z * z;
      outside += std::abs(z) > 1.959964 ? 1 : 0;
      ++count;
    }
  }
  ASSERT_GT(count, 400);
  EXPECT_NEAR(squares / count, 1, 0.25);
  EXPECT_NEAR(outside / count, 0.05, 0.025);
}

TEST(ReferenceEstimator, TwiceThePathsHalveTheVariance) {
  const scene::Scene scene = mixed_scene(true);
  const Traced truth = trace(scene, settings(10000, 100));
  const auto variance = [&](uint32_t paths) {
    double sum = 0;
    for (uint32_t seed = 0; seed < 8; ++seed) {
      const Traced traced = trace(scene, settings(paths, seed));
      for (size_t i = 0; i < traced.pixels.size(); ++i)
        sum += std::pow(static_cast<double>(traced.pixels[i].outgoing.g - truth.pixels[i].outgoing.g), 2);
    }
    return sum;
  };
  EXPECT_NEAR(variance(64) / variance(128), 2, 0.35);
}

TEST(ReferenceEstimator, ThreadsDoNotMatter) {
  const scene::Scene scene = mixed_scene(false);
  reference::ImageSettings chosen = settings(5, 1);
  chosen.width = 70;
  chosen.height = 37;
  chosen.threads = 1;
  const Traced one = trace(scene, chosen);
  for (const uint32_t threads : {2U, 5U, 16U}) {
    chosen.threads = threads;
    const Traced several = trace(scene, chosen);
    EXPECT_EQ(0, std::memcmp(one.pixels.data(), several.pixels.data(), one.pixels.size() * sizeof(one.pixels[0])));
  }
  chosen.seed = 2;
  EXPECT_NE(
      0, std::memcmp(one.pixels.data(), trace(scene, chosen).pixels.data(), one.pixels.size() * sizeof(one.pixels[0])));
}

TEST(ReferenceEstimator, LobesMakeUpTheWhole) {
  const Traced traced = trace(mixed_scene(false), settings(50, 1));
  uint32_t lit = 0;
  for (const reference::TracedPixel& pixel : traced.pixels) {
    if (pixel.lit == 0) continue;
    ++lit;
    EXPECT_GT(pixel.radiance.g, 0);
    EXPECT_GE(pixel.diffuse.g, 0);
    EXPECT_GE(pixel.specular.g, 0);
    // The modulation of both is the sum of those of either, so the quotient lies between.
    EXPECT_LE(pixel.radiance.g, std::max(pixel.diffuse.g, pixel.specular.g) * 1.0001f);
    EXPECT_GE(pixel.radiance.g, std::min(pixel.diffuse.g, pixel.specular.g) * 0.9999f);
  }
  EXPECT_GT(lit, 50U);
}

TEST(ReferenceEstimator, LightThatIsNoNumberIsAnError) {
  SceneBuilder builder;
  builder.quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, builder.material(matte(glm::vec3(1))));
  builder.scene.sun = scene::Sun{{0, -1, 0}, glm::vec3(3e38f), 0.1f};
  scene::Scene scene = builder.finish(flat_view({0, 0, 0}, {0, -1, 0}, 0.5f, {0, 0, -1}));
  EXPECT_THROW(trace(scene, settings(10, 1)), Error);
}

}  // namespace
}  // namespace lightloom::test
