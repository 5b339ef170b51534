#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/device_fixture.hpp"
#include "tests/support/snippet_runner.hpp"

// Where rays meet planes: rays are made in doubles through points of known weights.
namespace lightloom::test {
namespace {

struct Case {
  glm::dvec3 origin, direction;
  std::array<glm::dvec3, 3> corners;
  glm::dvec3 weights = {};  // expected
};

class PlaneWeights : public DeviceTest {
 protected:
  static std::vector<glm::dvec3> evaluate(const std::vector<Case>& cases, const std::string& function) {
    std::vector<float> input;
    for (const Case& c : cases)
      for (const glm::dvec3& v : {c.origin, c.direction, c.corners[0], c.corners[1], c.corners[2]})
        for (int k = 0; k < 3; ++k) input.push_back(static_cast<float>(v[k]));
    const std::vector<float> out = run_snippet(device(), R"(
#include "lib/plane_weights.glsl"
vec3 at(uint i) { return vec3(inputs[i], inputs[i + 1u], inputs[i + 2u]); }
void evaluate(uint index) {
  uint i = index * 15u;
  vec3 weights = plane_weights(at(i), at(i + 3u), Corners(at(i + 6u), at(i + 9u), at(i + 12u)));
  vec3 result = )" + function + R"(;
  for (uint k = 0u; k < 3u; ++k) outputs[index * 3u + k] = result[k];
})",
                                               input, cases.size() * 3, static_cast<uint32_t>(cases.size()));
    std::vector<glm::dvec3> result;
    for (size_t i = 0; i < cases.size(); ++i) result.emplace_back(out[3 * i], out[3 * i + 1], out[3 * i + 2]);
    return result;
  }

  /// Triangles with edges of about 1 some metres from a viewer, and points of their planes; `least` the smallest
  /// weight.
  static std::vector<Case> random_cases(double least) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-1, 1), weight(least, 1);
    std::vector<Case> cases;
    while (cases.size() < 2000) {
      Case c;
      c.origin = {place(random), place(random), place(random)};
      const glm::dvec3 centre(place(random), place(random), 5 + place(random));
      for (glm::dvec3& corner : c.corners) corner = centre + glm::dvec3(place(random), place(random), place(random));
      const double v = weight(random), w = weight(random);
      if (1 - v - w < least) continue;
      c.weights = {1 - v - w, v, w};
      const glm::dvec3 point = c.corners[0] * c.weights.x + c.corners[1] * v + c.corners[2] * w;
      c.direction = glm::normalize(point - c.origin);
      const glm::dvec3 normal = glm::cross(c.corners[1] - c.corners[0], c.corners[2] - c.corners[0]);
      // Nearly from the side, a float of the ray says little about the weights.
      if (std::abs(glm::dot(normal, c.direction)) > 0.1) cases.push_back(c);
    }
    return cases;
  }
};

TEST_F(PlaneWeights, AreThoseOfThePointThatTheRayWasAimedAt) {
  for (const double least : {0.0, -2.0}) {
    const std::vector<Case> cases = random_cases(least);
    const std::vector<glm::dvec3> weights = evaluate(cases, "weights");
    for (size_t i = 0; i < cases.size(); ++i)
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(weights[i][k], cases[i].weights[k], 1e-4) << i;
  }
}

TEST_F(PlaneWeights, WithinATriangleNothingIsMoved) {
  const std::vector<Case> cases = random_cases(0.001);
  const std::vector<glm::dvec3> weights = evaluate(cases, "weights_within(weights)");
  for (size_t i = 0; i < cases.size(); ++i)
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(weights[i][k], cases[i].weights[k], 1e-4) << i;
}

TEST_F(PlaneWeights, BesideATriangleAPointOfItIsTaken) {
  const std::vector<Case> cases = random_cases(-0.4);
  for (const glm::dvec3& weights : evaluate(cases, "weights_within(weights)")) {
    EXPECT_NEAR(weights.x + weights.y + weights.z, 1, 1e-6);
    for (int k = 0; k < 3; ++k) EXPECT_GE(weights[k], 0);
  }
}

TEST_F(PlaneWeights, AlongThePlaneAndWithoutAreaThereIsAPointAllTheSame) {
  const double huge = std::numeric_limits<float>::max();
  const std::vector<Case> cases = {
      {{0, 0, 0}, {0, 0, 1}, {{{0, 0, 1}, {0, 0, 2}, {0, 1, 1}}}, {}},           // in the plane
      {{1, 0, 0}, {0, 0, 1}, {{{0, 0, 1}, {0, 0, 2}, {0, 1, 1}}}, {}},           // beside it
      {{0, 0, 0}, {0, 0, 1}, {{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}}, {}},           // a point
      {{0, 0, 0}, {0, 0, 1}, {{{-1, 0, 1}, {0, 0, 1}, {1, 0, 1}}}, {}},          // a line
      {{0, 0, 0}, {0, 0, 1}, {{{-huge, 0, 1}, {huge, 0, 1}, {0, huge, 1}}}, {}}  // beyond floats
  };
  for (const glm::dvec3& weights : evaluate(cases, "weights_within(weights)")) {
    EXPECT_NEAR(weights.x + weights.y + weights.z, 1, 1e-6);
    for (int k = 0; k < 3; ++k) EXPECT_GE(weights[k], 0);
  }
}

}  // namespace
}  // namespace lightloom::test
