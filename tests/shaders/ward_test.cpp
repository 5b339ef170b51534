#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/shaders/ward_support.hpp"
#include "tests/shaders/ward_vectors.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

constexpr std::array kForms = {WardForm::ward_1992, WardForm::dur, WardForm::bounded};
constexpr std::array kSamplings = {WardSampling::exact, WardSampling::phi_uniform};

class Ward : public DeviceTest {};

std::vector<WardPair> vector_pairs() {
  std::vector<WardPair> pairs;
  for (const WardVector& v : kWardVectors)
    pairs.push_back({{radians(v.theta_i), radians(v.phi_i)}, {radians(v.theta_o), radians(v.phi_o)}, v.ax, v.ay});
  return pairs;
}

/// Relative error to allow for: a coordinate of h is off by one rounding of the directions' coordinates (6e-8), the
/// slope over alpha by 6e-8 / (alpha h.z) and the exponent by twice its root times that; the exponential adds 3 + 2 q
/// ulp.
double tolerance(const WardVector& v) {
  const Direction i{radians(v.theta_i), radians(v.phi_i)}, o{radians(v.theta_o), radians(v.phi_o)};
  const double hz = i.z() + o.z();
  const double slope = std::hypot((i.x() + o.x()) / v.ax, (i.y() + o.y()) / v.ay) / hz;
  const double slope_error = 1.2e-7 / (std::min(v.ax, v.ay) * hz);
  return 2e-6 + (2 * slope + slope_error) * slope_error + 2.4e-7 * slope * slope;
}

TEST_F(Ward, MatchesTestVectorsInEveryForm) {
  for (size_t form = 0; form < kForms.size(); ++form) {
    const std::vector<WardValues> results = evaluate_ward(device(), vector_pairs(), kForms[form]);
    for (size_t k = 0; k < kWardVectors.size(); ++k) {
      const WardVector& v = kWardVectors[k];
      EXPECT_NEAR(results[k].value / v.values[form], 1, tolerance(v)) << "form " << form << ", row " << k;
      EXPECT_NEAR(results[k].pdf / v.pdf[0], 1, tolerance(v)) << "density, row " << k;
    }
  }
}

TEST_F(Ward, MatchesTheDensityOfUniformAzimuths) {
  const std::vector<WardValues> results =
      evaluate_ward(device(), vector_pairs(), WardForm::bounded, WardSampling::phi_uniform);
  size_t defined = 0;
  for (size_t k = 0; k < kWardVectors.size(); ++k) {
    const WardVector& v = kWardVectors[k];
    EXPECT_TRUE(std::isfinite(results[k].pdf)) << "row " << k;
    if (std::isnan(v.pdf[1])) continue;
    ++defined;
    EXPECT_NEAR(results[k].pdf / v.pdf[1], 1, tolerance(v)) << "row " << k;
  }
  EXPECT_EQ(defined, 20u);
}

std::vector<WardPair> random_pairs(size_t count, double least_alpha) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> theta(0, radians(89.9)), phi(0, 2 * kPi), alpha(least_alpha, 1);
  std::vector<WardPair> pairs;
  for (size_t k = 0; k < count; ++k)
    pairs.push_back({{theta(random), phi(random)}, {theta(random), phi(random)}, alpha(random), alpha(random)});
  return pairs;
}

TEST_F(Ward, IsReciprocalBitByBit) {
  for (const WardForm form : kForms) {
    size_t positive = 0;
    for (const WardValues& v : evaluate_ward(device(), random_pairs(2000, 0.002), form)) {
      ASSERT_EQ(v.value, v.swapped);
      positive += v.value > 0 ? 1 : 0;
    }
    EXPECT_GT(positive, 1000u);
  }
}

TEST_F(Ward, WeightIsValueTimesCosineOverDensity) {
  const std::vector<WardPair> pairs = random_pairs(2000, 0.1);
  for (const WardForm form : kForms)
    for (const WardSampling sampling : kSamplings) {
      const std::vector<WardValues> values = evaluate_ward(device(), pairs, form, sampling);
      size_t counted = 0;
      for (size_t k = 0; k < pairs.size(); ++k) {
        if (values[k].pdf < 1e-20f) continue;
        ++counted;
        const double quotient = static_cast<double>(values[k].value) * pairs[k].o.z() / values[k].pdf;
        ASSERT_NEAR(values[k].weight / quotient, 1, 1e-5) << k;
      }
      EXPECT_GT(counted, 1000u);
    }
}

TEST_F(Ward, ReturnsZeroAtAndBelowTheHorizon) {
  const Direction up{radians(30), 0}, level{radians(90), 0}, below{radians(150), 0};
  for (const WardForm form : kForms)
    for (const WardValues& v :
         evaluate_ward(device(), {{level, up, 0.3, 0.3}, {up, level, 0.3, 0.3}, {up, below, 0.3, 0.3}}, form)) {
      EXPECT_EQ(v.value, 0);
      EXPECT_EQ(v.swapped, 0);
      EXPECT_EQ(v.pdf, 0);
      EXPECT_EQ(v.weight, 0);
    }
}

/// Extreme alphas and angles, and half vectors along the normal itself.
TEST_F(Ward, StaysFinite) {
  std::vector<WardPair> pairs;
  for (const double ax : {0.0, 1e-4, 1.0})
    for (const double ay : {0.0, 1.0})
      for (const double theta : {0.0, 45.0, 89.99, 89.9999})
        for (const double turn : {0.0, 90.0, 180.0})
          pairs.push_back({{radians(theta), 0.3}, {radians(theta), 0.3 + radians(turn)}, ax, ay});
  for (const WardForm form : kForms)
    for (const WardSampling sampling : kSamplings)
      for (const WardValues& v : evaluate_ward(device(), pairs, form, sampling)) {
        ASSERT_TRUE(std::isfinite(v.value) && std::isfinite(v.pdf) && std::isfinite(v.weight));
        ASSERT_TRUE(v.value >= 0 && v.pdf >= 0 && v.weight >= 0);
      }
}

/// Computed with 50 digits: what two numbers map to, and the weights of Walter's equation 10 and of the bounded
/// form.
struct MapRow {
  Lobe lobe;
  float u, v;
  double x, y, z, pdf, weight_1992, weight_bounded;
};

const std::vector<MapRow>& map_rows() {
  static const std::vector<MapRow> rows = {
      {{{radians(30), 0}, 0.2, 0.2},
       0.1f,
       0.05f,
       -0.389713868609,
       0.0358341363102,
       0.920238564335,
       2.01318397837,
       0.91679890812,
       1.0303500275},
      {{{radians(30), 0}, 0.1, 0.3},
       0.5f,
       0.25f,
       -0.5,
       0.407205278799,
       0.764319214019,
       1.72850516032,
       0.720842323693,
       0.93761675375},
      {{{radians(30), 0}, 0.1, 0.3},
       0.5f,
       0.75f,
       -0.5,
       -0.407205278799,
       0.764319214019,
       1.72850516032,
       0.720842323693,
       0.93761675375},
      {{{radians(45), radians(37)}, 0.1, 0.3},
       0.9f,
       0.4f,
       -0.734549839825,
       -0.0553829551762,
       0.676290811034,
       0.416724116816,
       0.622507357268,
       0.97772442982},
      {{{radians(60), radians(90)}, 0.05, 0.5},
       0.25f,
       0.125f,
       0.0243087978116,
       -0.622937425668,
       0.781893884137,
       3.85996291846,
       0.773423144441,
       1.21990422735},
      {{{radians(10), 0}, 0.3, 0.3},
       0.999f,
       0.3f,
       -0.456860709752,
       0.87163854752,
       0.177551497776,
       0.0024672162698,
       0.152169231353,
       0.305501930932},
      {{{radians(30), radians(20)}, 0.001, 0.5},
       0.5f,
       0.5f,
       -0.471287684935,
       -0.171010071663,
       0.865241858337,
       91.9298001481,
       0.865241347212,
       0.999547415085},
      {{{0, 0}, 1, 1},
       0.01f,
       0.9f,
       0.160596068889,
       -0.116679873879,
       0.980099336643,
       0.0803732195352,
       0.970396033892,
       0.989949664146},
  };
  return rows;
}

TEST_F(Ward, SamplesTheDirectionsOfTheMap) {
  for (const MapRow& row : map_rows()) {
    const WardSample s = sample_ward(device(), row.lobe, {row.u, row.v}, WardForm::bounded, WardSampling::exact)[0];
    // Vulkan lets sine and cosine be off by 2^-11.
    EXPECT_NEAR(s.x, row.x, 1.5e-3) << row.u;
    EXPECT_NEAR(s.y, row.y, 1.5e-3) << row.u;
    EXPECT_NEAR(s.z, row.z, 1.5e-3) << row.u;
    EXPECT_NEAR(s.weight, row.weight_bounded, 2e-3) << row.u;
    EXPECT_NEAR(s.pdf / row.pdf, 1, 1e-2) << row.u;
    const WardSample paper =
        sample_ward(device(), row.lobe, {row.u, row.v}, WardForm::ward_1992, WardSampling::exact)[0];
    EXPECT_NEAR(paper.weight, row.weight_1992, 2e-3) << row.u;
  }
}

TEST_F(Ward, LosesSamplesBelowTheHorizon) {
  const auto sample = [](const Lobe& lobe, float u, float v) {
    return sample_ward(device(), lobe, {u, v}, WardForm::bounded, WardSampling::exact)[0];
  };
  EXPECT_LT(sample({{radians(60), radians(10)}, 0.5, 0.05}, 0.75f, 0.625f).z, 0);
  const WardSample behind = sample({{radians(85), radians(180)}, 0.3, 0.3}, 0.6f, 0.1f);
  EXPECT_LE(behind.z, 0);
  EXPECT_EQ(behind.weight, 0);
  EXPECT_EQ(behind.pdf, 0);
}

TEST_F(Ward, BothSamplingsAreOneForEqualAlphas) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(0, 0.9999f);
  std::vector<float> u;
  for (int k = 0; k < 1000; ++k) u.push_back(uniform(random));
  const Lobe lobe{{radians(50), 0.7}, 0.25, 0.25};
  const auto exact = sample_ward(device(), lobe, u, WardForm::bounded, WardSampling::exact);
  const auto uniform_phi = sample_ward(device(), lobe, u, WardForm::bounded, WardSampling::phi_uniform);
  for (size_t k = 0; k < exact.size(); ++k) {
    ASSERT_NEAR(exact[k].x, uniform_phi[k].x, 2e-6);
    ASSERT_NEAR(exact[k].z, uniform_phi[k].z, 2e-6);
    ASSERT_NEAR(exact[k].weight, uniform_phi[k].weight, 1e-5);
  }
}

}  // namespace
}  // namespace lightloom::test
