#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/support/device_fixture.hpp"
#include "tests/support/snippet_runner.hpp"

// What comes out of the packed guide is what went in, as closely as the shader's comments say.
namespace lightloom::test {
namespace {

struct Guide {
  double object = 1;
  double normal[3] = {0, 0, 1};
  double position[3] = {0, 0, 0};
  double variance = 0;
  double error = 1;
};
constexpr size_t kFloats = 9;

class FilterGuide : public DeviceTest {
 protected:
  static std::vector<Guide> round_trip(const std::vector<Guide>& guides) {
    std::vector<float> input;
    for (const Guide& g : guides) {
      for (const double value : {g.object, g.normal[0], g.normal[1], g.normal[2], g.position[0], g.position[1],
                                 g.position[2], g.variance, g.error})
        input.push_back(static_cast<float>(value));
    }
    const std::vector<float> out = run_snippet(device(), R"(
#include "lib/filter_guide.glsl"
void evaluate(uint index) {
  uint i = index * 9u;
  SurfacePoint point = SurfacePoint(vec3(inputs[i + 1u], inputs[i + 2u], inputs[i + 3u]),
                                    vec3(inputs[i + 4u], inputs[i + 5u], inputs[i + 6u]));
  Guide g = Guide(uint(inputs[i]), point, inputs[i + 7u], inputs[i + 8u]);
  Guide back = unpack_guide(pack_guide(g));
  outputs[i] = float(back.object);
  for (uint k = 0u; k < 3u; ++k) {
    outputs[i + 1u + k] = back.point.normal[k];
    outputs[i + 4u + k] = back.point.position[k];
  }
  outputs[i + 7u] = back.variance;
  outputs[i + 8u] = back.error;
})",
                                               input, input.size(), static_cast<uint32_t>(guides.size()));
    std::vector<Guide> result(guides.size());
    for (size_t i = 0; i < guides.size(); ++i) {
      const float* o = &out[i * kFloats];
      result[i] = {o[0], {o[1], o[2], o[3]}, {o[4], o[5], o[6]}, o[7], o[8]};
    }
    return result;
  }

  static std::vector<Guide> random_guides() {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> exponent(-20, 20), error(-6.2, 4.8);
    std::vector<Guide> guides;
    for (int i = 0; i < 4000; ++i) {
      Guide g;
      g.object = static_cast<double>(random() & 0xFFFFFFu);
      double length = 0;
      for (double& n : g.normal) {
        n = normal(random);
        length += n * n;
      }
      for (double& n : g.normal) n /= std::sqrt(length);
      const double scale = std::exp(exponent(random));
      for (double& p : g.position) p = scale * normal(random);
      g.variance = std::exp(exponent(random));
      g.error = std::exp(error(random));
      guides.push_back(g);
    }
    return guides;
  }
};

double sine_between(const double* a, const double* b) {
  const double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
  return std::sqrt(x * x + y * y + z * z);
}

TEST_F(FilterGuide, KeepsEachPartToItsPrecision) {
  const std::vector<Guide> guides = random_guides();
  const std::vector<Guide> back = round_trip(guides);
  for (size_t i = 0; i < guides.size(); ++i) {
    EXPECT_EQ(back[i].object, guides[i].object);
    EXPECT_LT(sine_between(back[i].normal, guides[i].normal), 0.001) << i;
    double largest = 0;
    for (const double p : guides[i].position) largest = std::max(largest, std::abs(p));
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(back[i].position[k], guides[i].position[k], largest / 32768) << i;
    EXPECT_NEAR(back[i].variance / guides[i].variance, 1, 1.0 / 256) << i;
    EXPECT_NEAR(back[i].error / guides[i].error, 1, 1.0 / 40) << i;
  }
}

TEST_F(FilterGuide, KeepsDirectionsOfTheAxes) {
  std::vector<Guide> guides;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      Guide g;
      g.normal[2] = 0;
      g.normal[axis] = side;
      guides.push_back(g);
    }
  const std::vector<Guide> back = round_trip(guides);
  for (size_t i = 0; i < guides.size(); ++i)
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(back[i].normal[k], guides[i].normal[k], 0.001) << i;
}

TEST_F(FilterGuide, StandsTheExtremes) {
  std::vector<Guide> guides(6);
  guides[0].position[1] = 1e30;
  guides[1].position[0] = -1e-30;
  guides[2].variance = 1e36;
  guides[3].error = 1e18;
  guides[4].error = 0;
  guides[5].position[0] = guides[5].position[1] = guides[5].position[2] = -3e38;
  const std::vector<Guide> back = round_trip(guides);
  EXPECT_NEAR(back[0].position[1] / 1e30, 1, 1e-4);
  EXPECT_NEAR(back[1].position[0] / -1e-30, 1, 1e-4);
  EXPECT_NEAR(back[2].variance / 1e36, 1, 0.004);
  EXPECT_GT(back[3].error, 100) << "beyond any length that is left";
  EXPECT_LT(back[4].error, 0.002);
  for (const Guide& g : back)
    for (const double value : {g.position[0], g.position[1], g.position[2], g.variance, g.error})
      EXPECT_TRUE(std::isfinite(value));
  EXPECT_EQ(round_trip({Guide{}})[0].position[0], 0);
}

}  // namespace
}  // namespace lightloom::test
