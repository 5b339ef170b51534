#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "tests/shaders/statistics.hpp"
#include "tests/shaders/ward_oracle.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/snippet_runner.hpp"

namespace lightloom::test {
namespace {

class Ward : public DeviceTest {};

struct Vector {
  double theta_i, phi_i, theta_o, phi_o;  // [degrees]
  double ax, ay;
  double bounded, pdf;
};

// Computed with 50 digits.
const std::vector<Vector> kVectors = {
    {0, 0, 0, 0, 0.2, 0.2, 1.98943678865, 1.98943678865},
    {0, 0, 0, 0, 0.05, 0.5, 3.18309886184, 3.18309886184},
    {30, 0, 30, 180, 0.2, 0.2, 2.65258238486, 2.29720373092},
    {30, 0, 30, 180, 0.1, 0.3, 3.53677651315, 3.0629383079},
    {30, 90, 20, 260, 0.1, 0.3, 2.69178235426, 2.43029995766},
    {45, 0, 45, 180, 0.15, 0.15, 7.07355302631, 5.00175731198},
    {45, 0, 40, 175, 0.15, 0.15, 5.59923824933, 4.12426234109},
    {60, 10, 55, 195, 0.05, 0.2, 6.85180486051, 3.67796812236},
    {70, 0, 10, 0, 0.5, 0.5, 0.0737303903397, 0.0489137693553},
    {70, 0, 70, 0, 0.5, 0.5, 1.79195128342e-12, 6.12883434787e-13},
    {80, 0, 80, 180, 0.1, 0.1, 263.906250223, 45.8268394262},
    {85, 0, 85, 180, 0.3, 0.3, 116.40070478, 10.1449898815},
    {89, 0, 89, 180, 0.3, 0.3, 2902.93284832, 50.663163929},
    {89.9, 0, 89.9, 180, 0.3, 0.3, 290264.10463, 506.606175413},
    {89, 0, 45, 180, 0.3, 0.3, 1.27769747064, 0.462883720677},
    {45, 0, 89, 180, 0.3, 0.3, 1.27769747064, 0.462883720677},
    {0, 0, 60, 45, 1, 1, 0.135157925876, 0.101368444407},
    {60, 45, 0, 0, 1, 1, 0.135157925876, 0.101368444407},
    {20, 0, 60, 120, 0.1, 1, 1.00139716826, 0.720852056812},
    {10, 0, 10, 180, 0.01, 0.01, 820.516309576, 808.050823143},
};

const std::string kEvaluate = R"(
#include "lib/ward.glsl"
void evaluate(uint index) {
  uint at = 8u * index;
  vec3 i = vec3(inputs[at], inputs[at + 1u], inputs[at + 2u]);
  vec3 o = vec3(inputs[at + 3u], inputs[at + 4u], inputs[at + 5u]);
  vec2 alpha = vec2(inputs[at + 6u], inputs[at + 7u]);
  outputs[3u * index] = ward_evaluate(i, o, alpha);
  outputs[3u * index + 1u] = ward_pdf(i, o, alpha);
  outputs[3u * index + 2u] = ward_evaluate(o, i, alpha);
})";

void append(std::vector<float>& values, const Direction& d) {
  for (const double v : {d.x(), d.y(), d.z()}) values.push_back(static_cast<float>(v));
}

std::vector<float> evaluate_all(gpu::Device& device, const std::vector<Vector>& vectors) {
  std::vector<float> inputs;
  for (const Vector& v : vectors) {
    append(inputs, {radians(v.theta_i), radians(v.phi_i)});
    append(inputs, {radians(v.theta_o), radians(v.phi_o)});
    inputs.push_back(static_cast<float>(v.ax));
    inputs.push_back(static_cast<float>(v.ay));
  }
  return run_snippet(device, kEvaluate, inputs, 3 * vectors.size(), static_cast<uint32_t>(vectors.size()));
}

TEST_F(Ward, MatchesTestVectors) {
  const std::vector<float> results = evaluate_all(device(), kVectors);
  for (size_t k = 0; k < kVectors.size(); ++k) {
    const Vector& v = kVectors[k];
    // Rounding of the directions alone moves the exponent by about 1e-7 q / alpha, and 1/cos^4 near the horizon.
    const double tolerance = 1e-4 + 2e-6 / (std::cos(radians(std::max(v.theta_i, v.theta_o))) * std::min(v.ax, v.ay));
    EXPECT_NEAR(results[3 * k] / v.bounded, 1, tolerance) << "value, row " << k;
    EXPECT_NEAR(results[3 * k + 1] / v.pdf, 1, tolerance) << "density, row " << k;
  }
}

TEST_F(Ward, IsReciprocalBitByBit) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> theta(0, 89.9), phi(0, 360), alpha(0.002, 1);
  std::vector<Vector> pairs;
  for (int k = 0; k < 2000; ++k)
    pairs.push_back({theta(random), phi(random), theta(random), phi(random), alpha(random), alpha(random), 0, 0});
  const std::vector<float> results = evaluate_all(device(), pairs);
  for (size_t k = 0; k < pairs.size(); ++k) ASSERT_EQ(results[3 * k], results[3 * k + 2]) << k;
}

TEST_F(Ward, ReturnsZeroAtAndBelowTheHorizon) {
  const std::vector<float> results = evaluate_all(
      device(), {{90, 0, 30, 0, 0.3, 0.3, 0, 0}, {30, 0, 90, 0, 0.3, 0.3, 0, 0}, {30, 0, 150, 0, 0.3, 0.3, 0, 0}});
  for (const float value : results) EXPECT_EQ(value, 0);
}

const std::string kSample = R"(
#include "lib/ward.glsl"
void evaluate(uint index) {
  vec3 i = vec3(inputs[0], inputs[1], inputs[2]);
  vec2 alpha = vec2(inputs[3], inputs[4]);
  vec2 u = vec2(inputs[5u + 2u * index], inputs[6u + 2u * index]);
  vec3 o = ward_sample(i, u, alpha);
  outputs[4u * index] = o.x;
  outputs[4u * index + 1u] = o.y;
  outputs[4u * index + 2u] = o.z;
  outputs[4u * index + 3u] = o.z > 0.0 ? ward_weight(i, o, alpha) : 0.0;
})";

struct Lobe {
  Direction incoming;
  double ax, ay;
};

std::vector<float> sample_all(gpu::Device& device, const Lobe& lobe, const std::vector<float>& u) {
  std::vector<float> inputs;
  append(inputs, lobe.incoming);
  inputs.push_back(static_cast<float>(lobe.ax));
  inputs.push_back(static_cast<float>(lobe.ay));
  inputs.insert(inputs.end(), u.begin(), u.end());
  return run_snippet(device, kSample, inputs, 2 * u.size(), static_cast<uint32_t>(u.size() / 2));
}

TEST_F(Ward, SamplesTheDirectionsOfTheMap) {
  struct Row {
    Lobe lobe;
    float u, v;
    double x, y, z, weight;
  };
  const std::vector<Row> rows = {
      {{{radians(30), 0}, 0.2, 0.2}, 0.1f, 0.05f, -0.389713868609, 0.0358341363102, 0.920238564335, 1.0303500275},
      {{{radians(30), 0}, 0.1, 0.3}, 0.5f, 0.25f, -0.5, 0.407205278799, 0.764319214019, 0.93761675375},
      {{{radians(30), 0}, 0.1, 0.3}, 0.5f, 0.75f, -0.5, -0.407205278799, 0.764319214019, 0.93761675375},
      {{{radians(45), radians(37)}, 0.1, 0.3},
       0.9f,
       0.4f,
       -0.734549839825,
       -0.0553829551762,
       0.676290811034,
       0.97772442982},
      {{{radians(60), radians(90)}, 0.05, 0.5},
       0.25f,
       0.125f,
       0.0243087978116,
       -0.622937425668,
       0.781893884137,
       1.21990422735},
      {{{radians(30), radians(20)}, 0.001, 0.5},
       0.5f,
       0.5f,
       -0.471287684935,
       -0.171010071663,
       0.865241858337,
       0.999547415085},
      {{{0, 0}, 1, 1}, 0.01f, 0.9f, 0.160596068889, -0.116679873879, 0.980099336643, 0.989949664146},
  };
  for (const Row& row : rows) {
    const std::vector<float> o = sample_all(device(), row.lobe, {row.u, row.v});
    // Vulkan lets sine and cosine be off by 2^-11.
    EXPECT_NEAR(o[0], row.x, 1.5e-3) << row.u;
    EXPECT_NEAR(o[1], row.y, 1.5e-3) << row.u;
    EXPECT_NEAR(o[2], row.z, 1.5e-3) << row.u;
    EXPECT_NEAR(o[3], row.weight, 2e-3) << row.u;
  }
}

TEST_F(Ward, LosesSamplesBelowTheHorizon) {
  EXPECT_LT(sample_all(device(), {{radians(60), radians(10)}, 0.5, 0.05}, {0.75f, 0.625f})[2], 0);
  EXPECT_LE(sample_all(device(), {{radians(85), radians(180)}, 0.3, 0.3}, {0.6f, 0.1f})[2], 0);
}

/// Mean weight over a regular grid of (u, v): the albedo under white light.
double albedo(gpu::Device& device, const Lobe& lobe) {
  std::vector<float> u;
  const int side = 256;
  for (int a = 0; a < side; ++a)
    for (int b = 0; b < side; ++b) {
      u.push_back((static_cast<float>(a) + 0.5f) / side);
      u.push_back((static_cast<float>(b) + 0.5f) / side);
    }
  const std::vector<float> samples = sample_all(device, lobe, u);
  double sum = 0;
  for (size_t k = 3; k < samples.size(); k += 4) sum += samples[k];
  return sum / (side * side);
}

TEST_F(Ward, ReflectsTheKnownShareOfWhiteLight) {
  for (const double alpha : {0.05, 0.1, 0.2, 0.3, 0.5, 1.0}) {
    const double exact = 1 - alpha * alpha * (1 - std::exp(-1 / (alpha * alpha)));
    EXPECT_NEAR(albedo(device(), {{0, 0}, alpha, alpha}), exact, 2e-3) << alpha;
  }
  EXPECT_NEAR(albedo(device(), {{radians(45), 0}, 0.1, 0.5}), 0.86563, 2e-3);
  EXPECT_NEAR(albedo(device(), {{radians(60), radians(90)}, 0.1, 0.5}), 0.78567, 2e-3);
  EXPECT_NEAR(albedo(device(), {{radians(80), 0}, 0.3, 0.3}), 0.78047, 3e-3);
}

TEST_F(Ward, NeverReflectsMoreThanArrives) {
  for (const double theta : {0.0, 45.0, 75.0, 88.0, 89.9})
    for (const double ax : {0.002, 0.1, 0.5, 1.0})
      EXPECT_LE(albedo(device(), {{radians(theta), 0.3}, ax, 0.3}), 1.001) << theta << " " << ax;
}

/// Chi-square of GPU samples against a density over 20 x 40 cells of (theta, phi) and one for what is lost.
ChiSquare compare(gpu::Device& device, const Lobe& sampled, const Lobe& expected_lobe) {
  const int rows = 20, columns = 40, fine = 12, count = 200000;
  const double pi = 3.141592653589793;
  std::mt19937 random(11);
  std::uniform_int_distribution<uint32_t> bits(0, (1u << 24) - 1);
  std::vector<float> u;
  for (int k = 0; k < 2 * count; ++k) u.push_back(static_cast<float>(bits(random)) / 16777216.0f);
  const std::vector<float> o = sample_all(device, sampled, u);
  std::vector<double> observed(rows * columns + 1), expected(rows * columns + 1);
  for (int k = 0; k < count; ++k) {
    const float x = o[4 * k], y = o[4 * k + 1], z = o[4 * k + 2];
    if (z <= 0) {
      ++observed.back();
      continue;
    }
    const double phi = std::atan2(y, x) < 0 ? std::atan2(y, x) + 2 * pi : std::atan2(y, x);
    const int row = std::min(rows - 1, static_cast<int>(std::acos(std::min(1.0f, z)) / (pi / 2) * rows));
    const int column = std::min(columns - 1, static_cast<int>(phi / (2 * pi) * columns));
    ++observed[row * columns + column];
  }
  double total = 0;
  const double d_theta = pi / 2 / rows / fine, d_phi = 2 * pi / columns / fine;
  for (int a = 0; a < rows * fine; ++a)
    for (int b = 0; b < columns * fine; ++b) {
      const Direction direction{(a + 0.5) * d_theta, (b + 0.5) * d_phi};
      const double mass = ward_pdf_oracle(expected_lobe.incoming, direction, expected_lobe.ax, expected_lobe.ay) *
                          std::sin(direction.theta) * d_theta * d_phi;
      expected[a / fine * columns + b / fine] += count * mass;
      total += mass;
    }
  expected.back() = count * std::max(0.0, 1 - total);
  return chi_square(observed, expected);
}

TEST_F(Ward, SamplesFollowTheDensity) {
  const std::vector<Lobe> lobes = {
      {{radians(30), 0}, 0.2, 0.2},
      {{radians(45), radians(37)}, 0.1, 0.3},
      {{radians(80), radians(10)}, 0.1, 0.3},
      {{radians(60), radians(90)}, 0.1, 0.5},
      {{radians(30), 0}, 1, 1},
      {{radians(85), radians(200)}, 0.5, 0.25},
  };
  for (const Lobe& lobe : lobes) {
    const ChiSquare result = compare(device(), lobe, lobe);
    EXPECT_GT(result.p_value, 1e-4) << "chi2 " << result.statistic << " of " << result.degrees << ", theta "
                                    << lobe.incoming.theta;
  }
}

TEST_F(Ward, ChiSquareNoticesAWrongDensity) {
  const Lobe lobe{{radians(45), radians(37)}, 0.1, 0.3};
  EXPECT_LT(compare(device(), lobe, {lobe.incoming, 0.3, 0.1}).p_value, 1e-9);
  EXPECT_LT(compare(device(), lobe, {lobe.incoming, 0.1, 0.32}).p_value, 1e-9);
}

}  // namespace
}  // namespace lightloom::test
