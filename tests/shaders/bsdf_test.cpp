#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/shaders/ward_support.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/snippet_runner.hpp"

namespace lightloom::test {
namespace {

class BsdfTest : public DeviceTest {};

struct Surface {
  float base, metallic, f0, f90, ax, ay;
};

const std::string kRead = R"(
#include "lib/bsdf.glsl"
#include "lib/modulation.glsl"
Bsdf surface() { return Bsdf(vec3(inputs[0]), inputs[1], inputs[2], inputs[3], vec2(inputs[4], inputs[5])); }
vec3 at(uint k) { return vec3(inputs[6u + 3u * k], inputs[7u + 3u * k], inputs[8u + 3u * k]); }
)";

std::vector<float> run(gpu::Device& device, const Surface& s, const std::vector<float>& vectors,
                       const std::string& body, uint32_t invocations, size_t outputs,
                       const std::vector<ShaderValue>& constants = {}) {
  std::vector<float> inputs = {s.base, s.metallic, s.f0, s.f90, s.ax, s.ay};
  inputs.insert(inputs.end(), vectors.begin(), vectors.end());
  return run_snippet(device, kRead + body, inputs, outputs, invocations, constants);
}

const std::string kSample = R"(
void evaluate(uint index) {
  BsdfSample s = bsdf_sample(surface(), at(0u), at(index + 1u));
  uint to = 8u * index;
  outputs[to] = s.weight.x;
  outputs[to + 1u] = s.pdf;
  outputs[to + 2u] = s.direction.z;
  outputs[to + 3u] = bsdf_evaluate(surface(), at(0u), s.direction).x;
  outputs[to + 4u] = s.mirror ? 1.0 : 0.0;
  outputs[to + 5u] = s.direction.x;
  outputs[to + 6u] = s.direction.y;
})";

/// Samples on a 32^3 grid of the three numbers: 8 floats each.
std::vector<float> sample_grid(gpu::Device& device, const Surface& surface, const Direction& incoming,
                               const std::vector<ShaderValue>& constants = {}) {
  std::vector<float> vectors;
  append(vectors, incoming);
  const int side = 32;
  for (int a = 0; a < side; ++a)
    for (int b = 0; b < side; ++b)
      for (int c = 0; c < side; ++c)
        for (const int n : {a, b, c}) vectors.push_back((static_cast<float>(n) + 0.5f) / side);
  const uint32_t count = side * side * side;
  return run(device, surface, vectors, kSample, count, 8 * size_t{count}, constants);
}

double mean_weight(const std::vector<float>& samples) {
  double sum = 0;
  for (size_t k = 0; k < samples.size(); k += 8) sum += samples[k];
  return sum / static_cast<double>(samples.size() / 8);
}

TEST_F(BsdfTest, LambertianSurfaceReflectsItsBaseColour) {
  const Surface lambertian{0.6f, 0, 0, 0, 0.3f, 0.3f};
  for (const double theta : {0.0, 60.0, 85.0}) {
    const std::vector<float> samples = sample_grid(device(), lambertian, {radians(theta), 1});
    EXPECT_NEAR(mean_weight(samples), 0.6, 1e-5) << theta;
    for (size_t k = 0; k < samples.size(); k += 8) ASSERT_NEAR(samples[k + 3], 0.6 / 3.14159265, 1e-6);
  }
}

TEST_F(BsdfTest, ReflectsNoMoreThanArrives) {
  for (const float metallic : {0.0f, 0.5f, 1.0f})
    for (const float alpha : {0.002f, 0.05f, 0.3f, 1.0f})
      for (const double theta : {0.0, 70.0, 89.0}) {
        const double albedo =
            mean_weight(sample_grid(device(), {1, metallic, 0.04f, 1, alpha, alpha}, {radians(theta), 0.4}));
        EXPECT_LE(albedo, 1.003) << metallic << " " << alpha << " " << theta;
        EXPECT_GE(albedo, 0.25) << metallic << " " << alpha << " " << theta;
      }
}

TEST_F(BsdfTest, SmoothWhiteDielectricReflectsNearlyEverything) {
  EXPECT_NEAR(mean_weight(sample_grid(device(), {1, 0, 0.04f, 1, 0.05f, 0.05f}, {radians(20), 0})), 1, 0.01);
}

/// Samples whose weight is not f cos / pdf; `counted` of them were not lost.
int wrong_weights(const std::vector<float>& samples, int& counted) {
  int wrong = 0;
  for (size_t k = 0; k < samples.size(); k += 8) {
    if (samples[k] <= 0) continue;
    ++counted;
    const double expected = static_cast<double>(samples[k + 3]) * samples[k + 2] / samples[k + 1];
    if (!(std::abs(samples[k] / expected - 1) < 1e-4)) ++wrong;
  }
  return wrong;
}

TEST_F(BsdfTest, WeightIsValueTimesCosineOverDensity) {
  for (const WardForm form : {WardForm::ward_1992, WardForm::dur, WardForm::bounded})
    for (const WardSampling sampling : {WardSampling::exact, WardSampling::phi_uniform})
      for (const float metallic : {0.3f, 1.0f}) {
        const std::vector<float> samples = sample_grid(device(), {0.7f, metallic, 0.04f, 1, 0.2f, 0.5f},
                                                       {radians(50), 2}, ward_constants(form, sampling));
        int counted = 0;
        EXPECT_EQ(wrong_weights(samples, counted), 0) << static_cast<int>(form) << " " << metallic;
        EXPECT_GT(counted, 20000);
      }
}

/// A rough metal alone: the weight is Fresnel's term times at most 2, however sharp the lobe.
TEST_F(BsdfTest, WeightsOfBoundedMetalsStayBelowTwo) {
  for (const float alpha : {0.0011f, 0.01f, 0.3f, 1.0f})
    for (const double theta : {0.0, 60.0, 89.0}) {
      const std::vector<float> samples = sample_grid(device(), {1, 1, 0.04f, 1, alpha, 0.5f}, {radians(theta), 0.3});
      for (size_t k = 0; k < samples.size(); k += 8) ASSERT_LE(samples[k], 2.0001f) << alpha << " " << theta;
    }
}

const std::string kDensity = R"(
void evaluate(uint index) {
  outputs[3u * index] = bsdf_pdf(surface(), at(0u), at(index + 1u));
  outputs[3u * index + 1u] = bsdf_evaluate(surface(), at(0u), at(index + 1u)).x;
  outputs[3u * index + 2u] = bsdf_evaluate(surface(), at(index + 1u), at(0u)).x;
})";

TEST_F(BsdfTest, DensityIntegratesToTheShareOfSamplesAboveTheHorizon) {
  const Surface surface{0.7f, 0.3f, 0.04f, 1, 0.3f, 0.6f};
  const Direction incoming{radians(65), 0.5};
  std::vector<float> vectors;
  append(vectors, incoming);
  const int rows = 180, columns = 360;
  for (int a = 0; a < rows; ++a)
    for (int b = 0; b < columns; ++b) append(vectors, {radians((a + 0.5) / 2), radians(b + 0.5)});
  const uint32_t count = rows * columns;
  const std::vector<float> densities = run(device(), surface, vectors, kDensity, count, 3 * size_t{count});
  double integral = 0, albedo = 0;
  for (int a = 0; a < rows; ++a)
    for (int b = 0; b < columns; ++b) {
      const double theta = radians((a + 0.5) / 2);
      const double solid_angle = std::sin(theta) * radians(0.5) * radians(1);
      const size_t at = 3 * static_cast<size_t>(a * columns + b);
      integral += densities[at] * solid_angle;
      albedo += densities[at + 1] * std::cos(theta) * solid_angle;
    }
  const std::vector<float> samples = sample_grid(device(), surface, incoming);
  double above = 0;
  for (size_t k = 0; k < samples.size(); k += 8) above += samples[k + 2] > 0 ? 1 : 0;
  EXPECT_NEAR(integral, above / static_cast<double>(samples.size() / 8), 5e-3);
  EXPECT_NEAR(albedo, mean_weight(samples), 5e-3);
}

TEST_F(BsdfTest, IsReciprocal) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> theta(0, 1.55), phi(0, 6.28);
  std::vector<float> vectors;
  append(vectors, {0.8, 0.3});
  for (int k = 0; k < 1000; ++k) append(vectors, {theta(random), phi(random)});
  const std::vector<float> values = run(device(), {0.7f, 0.3f, 0.04f, 1, 0.1f, 0.6f}, vectors, kDensity, 1000, 3000);
  for (size_t k = 0; k < values.size(); k += 3) ASSERT_NEAR(values[k + 1], values[k + 2], 2e-6 * (1 + values[k + 1]));
}

TEST_F(BsdfTest, RoughnessZeroIsAMirror) {
  const std::vector<float> samples = sample_grid(device(), {0.9f, 1, 0.04f, 1, 0.001f, 0.001f}, {radians(40), 0});
  for (size_t k = 0; k < samples.size(); k += 8) {
    ASSERT_EQ(samples[k + 4], 1.0f);
    ASSERT_NEAR(samples[k + 5], -std::sin(radians(40)), 1e-6);
    ASSERT_NEAR(samples[k], 0.9, 1e-3);
  }
}

TEST_F(BsdfTest, ModulationColourIsTheAlbedoOfASmoothSurface) {
  const std::string body = "void evaluate(uint index) { outputs[0] = modulation_color(surface(), at(0u).z).x; }";
  for (const double theta : {0.0, 30.0, 60.0}) {
    std::vector<float> vectors;
    append(vectors, {radians(theta), 0});
    const Surface surface{0.5f, 0, 0.04f, 1, 0.02f, 0.02f};
    const double color = run(device(), surface, vectors, body, 1, 1)[0];
    EXPECT_NEAR(mean_weight(sample_grid(device(), surface, {radians(theta), 0})), color, 0.01) << theta;
  }
  std::vector<float> up;
  append(up, {0, 0});
  EXPECT_FLOAT_EQ(run(device(), {0, 0, 0, 0, 1, 1}, up, body, 1, 1)[0], 1e-3f) << "black stays divisible";
}

}  // namespace
}  // namespace lightloom::test
