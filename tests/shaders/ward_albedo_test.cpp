#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/shaders/ward_albedo_table.hpp"
#include "tests/shaders/ward_support.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/snippet_runner.hpp"

// Directional albedo: how much of white light from one direction a lobe reflects.
namespace lightloom::test {
namespace {

class WardAlbedoTest : public DeviceTest {};

constexpr uint32_t kSide = 512;

struct Moments {
  double mean, variance;
  double lost;  ///< share of samples below the horizon
};

/// Mean and variance of the weights of a regular grid of kSide^2 samples; for many lobes at once.
const std::string kMoments = R"(
#include "lib/ward.glsl"
void evaluate(uint index) {
  uint at = 5u * (index / 512u);
  vec3 i = vec3(inputs[at], inputs[at + 1u], inputs[at + 2u]);
  vec2 alpha = vec2(inputs[at + 3u], inputs[at + 4u]);
  float sum = 0.0;
  float squares = 0.0;
  float lost = 0.0;
  for (uint k = 0u; k < 512u; ++k) {
    vec2 u = (vec2(k, index % 512u) + 0.5) / 512.0;
    vec3 o = ward_sample(i, u, alpha);
    float weight = ward_weight(i, o, alpha);
    if (o.z <= 0.0) lost += 1.0;
    sum += weight;
    squares += weight * weight;
  }
  outputs[3u * index] = sum;
  outputs[3u * index + 1u] = squares;
  outputs[3u * index + 2u] = lost;
})";

std::vector<float> lobe_inputs(const std::vector<Lobe>& lobes) {
  std::vector<float> inputs;
  for (const Lobe& lobe : lobes) {
    append(inputs, lobe.incoming);
    inputs.push_back(static_cast<float>(lobe.ax));
    inputs.push_back(static_cast<float>(lobe.ay));
  }
  return inputs;
}

std::vector<Moments> weight_moments(gpu::Device& device, const std::vector<Lobe>& lobes, WardForm form,
                                    WardSampling sampling = WardSampling::exact) {
  const auto invocations = static_cast<uint32_t>(lobes.size() * kSide);
  const std::vector<float> sums = run_snippet(device, kMoments, lobe_inputs(lobes), 3 * size_t{invocations},
                                              invocations, ward_constants(form, sampling));
  std::vector<Moments> moments;
  const double count = double{kSide} * kSide;
  for (size_t lobe = 0; lobe < lobes.size(); ++lobe) {
    double sum = 0, squares = 0, lost = 0;
    for (size_t k = 0; k < kSide; ++k) {
      sum += sums[3 * (lobe * kSide + k)];
      squares += sums[3 * (lobe * kSide + k) + 1];
      lost += sums[3 * (lobe * kSide + k) + 2];
    }
    moments.push_back({sum / count, squares / count - (sum / count) * (sum / count), lost / count});
  }
  return moments;
}

std::vector<Lobe> table_lobes() {
  std::vector<Lobe> lobes;
  for (const WardAlbedo& row : kWardAlbedos) lobes.push_back({{radians(row.theta), radians(row.phi)}, row.ax, row.ay});
  return lobes;
}

TEST_F(WardAlbedoTest, IsWhatQuadratureSaysForEveryForm) {
  const std::vector<Lobe> lobes = table_lobes();
  for (const WardForm form : {WardForm::ward_1992, WardForm::dur, WardForm::bounded}) {
    const std::vector<Moments> moments = weight_moments(device(), lobes, form);
    for (size_t k = 0; k < lobes.size(); ++k) {
      const double expected = kWardAlbedos[k].albedo[static_cast<size_t>(form)];
      EXPECT_NEAR(moments[k].mean, expected, 1e-3 * std::max(1.0, expected))
          << "form " << static_cast<int>(form) << ", alpha " << lobes[k].ax << " " << lobes[k].ay << ", theta "
          << kWardAlbedos[k].theta << ", phi " << kWardAlbedos[k].phi;
    }
  }
}

TEST_F(WardAlbedoTest, HasAClosedFormAtNormalIncidence) {
  std::vector<Lobe> lobes;
  for (const double alpha : {0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0}) lobes.push_back({{0, 0}, alpha, alpha});
  const std::vector<Moments> moments = weight_moments(device(), lobes, WardForm::bounded);
  for (size_t k = 0; k < lobes.size(); ++k) {
    const double squared = lobes[k].ax * lobes[k].ax;
    EXPECT_NEAR(moments[k].mean, 1 - squared * (1 - std::exp(-1 / squared)), 1e-3) << lobes[k].ax;
  }
}

TEST_F(WardAlbedoTest, OfTheBoundedFormIsNeverAboveOne) {
  std::vector<Lobe> lobes;
  for (const double ax : {1e-4, 0.002, 0.02, 0.1, 0.3, 0.6, 1.0})
    for (const double ay : {0.002, 0.05, 0.2, 0.5, 1.0})
      for (const double theta : {0.0, 30.0, 60.0, 75.0, 85.0, 88.0, 89.5, 89.9, 89.99})
        for (const double phi : {0.0, 45.0, 90.0}) lobes.push_back({{radians(theta), radians(phi)}, ax, ay});
  const std::vector<Moments> moments = weight_moments(device(), lobes, WardForm::bounded);
  for (size_t k = 0; k < lobes.size(); ++k) {
    EXPECT_LE(moments[k].mean, 1 + 1e-3) << lobes[k].ax << " " << lobes[k].ay << " " << lobes[k].incoming.theta;
    EXPECT_GE(moments[k].mean, 0.36) << lobes[k].ax << " " << lobes[k].ay << " " << lobes[k].incoming.theta;
  }
}

/// What uniform azimuths cost: means agree, variances were measured apart, in double precision.
TEST_F(WardAlbedoTest, IsTheSameBySamplingUniformAzimuthsAtAHigherVariance) {
  struct Row {
    double ratio, phi, mean, exact_variance, uniform_variance;
  };
  const std::vector<Row> rows = {{1, 0, 0.71674, 0.16504, 0.16504},  {2, 0, 0.81264, 0.07988, 0.22049},
                                 {2, 90, 0.78993, 0.15987, 0.32999}, {5, 0, 0.86564, 0.03552, 1.08281},
                                 {5, 90, 0.81239, 0.16063, 1.33602}, {10, 0, 0.87349, 0.03044, 2.78686}};
  std::vector<Lobe> lobes;
  for (const Row& row : rows) lobes.push_back({{radians(45), radians(row.phi)}, 0.5 / row.ratio, 0.5});
  const auto exact = weight_moments(device(), lobes, WardForm::bounded, WardSampling::exact);
  const auto uniform = weight_moments(device(), lobes, WardForm::bounded, WardSampling::phi_uniform);
  for (size_t k = 0; k < rows.size(); ++k) {
    EXPECT_NEAR(exact[k].mean, rows[k].mean, 1e-3) << k;
    EXPECT_NEAR(uniform[k].mean, rows[k].mean, 2e-3) << k;
    EXPECT_NEAR(exact[k].variance / rows[k].exact_variance, 1, 0.02) << k;
    EXPECT_NEAR(uniform[k].variance / rows[k].uniform_variance, 1, 0.03) << k;
  }
}

/// Integral of the density over the hemisphere. Lobes near the horizon are narrow there and around the mirror
/// direction, so cells shrink towards both: theta = pi/2 (1 - (1 - s)^3), phi = phi_i + pi + pi t^3.
const std::string kIntegrate = R"(
#include "lib/ward.glsl"
void evaluate(uint index) {
  uint at = 5u * (index / 512u);
  vec3 i = vec3(inputs[at], inputs[at + 1u], inputs[at + 2u]);
  vec2 alpha = vec2(inputs[at + 3u], inputs[at + 4u]);
  float t = (float(index % 512u) + 0.5) / 256.0 - 1.0;
  float across = kPi * t * t * t;
  vec2 mirrored = dot(i.xy, i.xy) > 0.0 ? -normalize(i.xy) : vec2(1.0, 0.0);
  vec2 along = mirrored * cos(across) + vec2(-mirrored.y, mirrored.x) * sin(across);
  float sum = 0.0;
  for (uint k = 0u; k < 512u; ++k) {
    float s = (float(k) + 0.5) / 512.0;
    float elevation = 0.5 * kPi * (1.0 - s) * (1.0 - s) * (1.0 - s);
    vec3 o = vec3(along * cos(elevation), sin(elevation));
    // `ward` has to be in the program, for its constant to have a place.
    float value = ward_weight(i, o, alpha) >= 0.0 ? ward_pdf(i, o, alpha) : 1e30;
    sum += value * cos(elevation) * (1.5 * kPi * (1.0 - s) * (1.0 - s));
  }
  outputs[index] = sum * 3.0 * kPi * t * t / (256.0 * 512.0);
})";

std::vector<double> density_integrals(gpu::Device& device, const std::vector<Lobe>& lobes, WardSampling sampling) {
  const auto invocations = static_cast<uint32_t>(lobes.size() * kSide);
  const std::vector<float> sums = run_snippet(device, kIntegrate, lobe_inputs(lobes), invocations, invocations,
                                              ward_constants(WardForm::bounded, sampling));
  std::vector<double> integrals(lobes.size());
  for (size_t k = 0; k < sums.size(); ++k) integrals[k / kSide] += sums[k];
  return integrals;
}

TEST_F(WardAlbedoTest, DensityIntegratesToTheShareOfSamplesThatIsNotLost) {
  const std::vector<double> integrals = density_integrals(device(), table_lobes(), WardSampling::exact);
  for (size_t k = 0; k < integrals.size(); ++k)
    EXPECT_NEAR(integrals[k], 1 - kWardAlbedos[k].lost, 1e-3)
        << "alpha " << kWardAlbedos[k].ax << " " << kWardAlbedos[k].ay << ", theta " << kWardAlbedos[k].theta
        << ", phi " << kWardAlbedos[k].phi;
}

TEST_F(WardAlbedoTest, DensityOfUniformAzimuthsIntegratesToTheShareOfSamplesThatIsNotLost) {
  const std::vector<Lobe> lobes = table_lobes();
  const std::vector<double> integrals = density_integrals(device(), lobes, WardSampling::phi_uniform);
  const std::vector<Moments> moments = weight_moments(device(), lobes, WardForm::bounded, WardSampling::phi_uniform);
  for (size_t k = 0; k < lobes.size(); ++k)
    EXPECT_NEAR(integrals[k], 1 - moments[k].lost, 1e-3) << lobes[k].ax << " " << lobes[k].ay << " row " << k;
  // Two rows of another quadrature, in double precision.
  const std::vector<Lobe> others = {{{radians(45), radians(37)}, 0.1, 0.3}, {{radians(85), radians(200)}, 0.5, 0.25}};
  const std::vector<double> other_integrals = density_integrals(device(), others, WardSampling::phi_uniform);
  EXPECT_NEAR(other_integrals[0], 0.99802, 1e-3);
  EXPECT_NEAR(other_integrals[1], 0.58288, 1e-3);
}

}  // namespace
}  // namespace lightloom::test
