#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/support/device_fixture.hpp"
#include "tests/support/snippet_runner.hpp"

namespace lightloom::test {
namespace {

class Sampling : public DeviceTest {
 protected:
  static std::vector<float> run(const std::string& body, const std::vector<float>& inputs, size_t outputs, uint32_t n) {
    return run_snippet(device(), "#include \"lib/sampling.glsl\"\nvoid evaluate(uint index) {" + body + "}", inputs,
                       outputs, n);
  }
};

TEST_F(Sampling, BalanceWeightsOfTwoStrategiesSumToOne) {
  const float huge = std::numeric_limits<float>::max();
  const std::vector<float> pairs = {1, 3, 1e-30f, 1e30f, huge, huge, huge, 0, 2, 0};
  const std::vector<float> w =
      run("float a = inputs[2u * index]; float b = inputs[2u * index + 1u];"
          "outputs[2u * index] = balance_weight(a, b); outputs[2u * index + 1u] = balance_weight(b, a);",
          pairs, pairs.size(), 5);
  for (size_t k = 0; k < pairs.size(); k += 2) EXPECT_NEAR(w[k] + w[k + 1], 1, 1e-6) << k;
  EXPECT_NEAR(w[0], 0.25, 1e-6);
}

TEST_F(Sampling, ConeIsCoveredUniformly) {
  const int side = 64;
  const double one_minus_cosine = 0.05;
  const std::vector<float> d =
      run("vec2 u = (vec2(index % 64u, index / 64u) + 0.5) / 64.0; vec3 axis = normalize(vec3(1.0, 2.0, -2.0));"
          "vec3 d = sample_cone(axis, 0.05, u); outputs[4u * index] = dot(d, axis); outputs[4u * index + 1u] = d.x;"
          "outputs[4u * index + 2u] = d.y; outputs[4u * index + 3u] = length(d);",
          {0}, 4 * side * side, side * side);
  double mean_cosine = 0, mean_x = 0, mean_y = 0, least = 1;
  for (size_t k = 0; k < d.size(); k += 4) {
    mean_cosine += d[k] / (side * side);
    mean_x += d[k + 1] / (side * side);
    mean_y += d[k + 2] / (side * side);
    least = std::min(least, static_cast<double>(d[k]));
    ASSERT_NEAR(d[k + 3], 1, 1e-5);
  }
  // Uniform on a cap: the cosine is uniform between 1 - h and 1, and the mean direction is the axis.
  EXPECT_NEAR(mean_cosine, 1 - one_minus_cosine / 2, 1e-3);
  EXPECT_NEAR(mean_x, (1 - one_minus_cosine / 2) / 3, 2e-3);
  EXPECT_NEAR(mean_y, (1 - one_minus_cosine / 2) * 2 / 3, 2e-3);
  EXPECT_GE(least, 1 - one_minus_cosine - 1e-3);
}

TEST_F(Sampling, FramesAreOrthonormalWhateverTheTangent) {
  const std::vector<float> tangents = {1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, -3, 2, 1};
  const std::vector<float> r = run(
      "vec3 n = normalize(vec3(1.0)); LocalFrame f = make_frame(n, vec3(inputs[3u * index], inputs[3u * index + 1u],"
      " inputs[3u * index + 2u])); vec3 v = vec3(0.3, -0.5, 0.8); vec3 back = to_world(f, to_local(f, v));"
      "outputs[4u * index] = dot(f.tangent, f.bitangent); outputs[4u * index + 1u] = dot(f.tangent, f.normal);"
      "outputs[4u * index + 2u] = length(f.tangent); outputs[4u * index + 3u] = length(back - v);",
      tangents, 20, 5);
  for (size_t k = 0; k < r.size(); k += 4) {
    EXPECT_NEAR(r[k], 0, 1e-6);
    EXPECT_NEAR(r[k + 1], 0, 1e-6);
    EXPECT_NEAR(r[k + 2], 1, 1e-6);
    EXPECT_NEAR(r[k + 3], 0, 1e-6);
  }
}

TEST_F(Sampling, TurnsNormalsTowardsTheViewerOnlyWhereNeeded) {
  const std::vector<float> r = run(
      "vec3 v = vec3(0.0, 0.0, 1.0); vec3 n = index == 0u ? vec3(0.6, 0.0, 0.8) : index == 1u ? vec3(1.0, 0.0, 0.0) :"
      "vec3(0.8, 0.0, -0.6); vec3 f = facing_normal(n, v); outputs[2u * index] = dot(f, v); outputs[2u * index + 1u] = "
      "length(f - n);",
      {0}, 6, 3);
  EXPECT_NEAR(r[1], 0, 1e-6);
  EXPECT_GT(r[2], 0.01);
  EXPECT_GT(r[4], 0.01);
}

TEST_F(Sampling, TellsNumbersFromWhatIsNone) {
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> r =
      run("outputs[index] = is_finite(inputs[index]) ? 1.0 : 0.0;", {0, 1e38f, -1e-40f, inf, -inf, nan}, 6, 6);
  EXPECT_EQ(r, (std::vector<float>{1, 1, 1, 0, 0, 0}));
}

}  // namespace
}  // namespace lightloom::test
