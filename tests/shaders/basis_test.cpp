#include <gtest/gtest.h>

#include <glm/glm.hpp>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/device_fixture.hpp"
#include "tests/support/snippet_runner.hpp"

namespace lightloom::test {
namespace {

using BasisTest = DeviceTest;

std::vector<glm::vec3> unit_vectors(size_t count) {
  std::vector<glm::vec3> result = {{1, 0, 0},      {0, 1, 0},      {0, 0, 1},         {-1, 0, 0},
                                   {0, -1, 0},     {0, 0, -1},     {1, 1, 1},         {-1, -1, -1},
                                   {0, 1e-6f, -1}, {1e-6f, 0, -1}, {1e-4f, 1e-4f, -1}};
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  while (result.size() < count) result.emplace_back(normal(random), normal(random), normal(random));
  for (glm::vec3& v : result) v = glm::normalize(v);
  return result;
}

glm::dvec3 vector_at(const std::vector<float>& values, size_t index) {
  return {values[3 * index], values[3 * index + 1], values[3 * index + 2]};
}

TEST_F(BasisTest, IsOrthonormalAndRightHandedForEveryDirection) {
  const std::vector<glm::vec3> normals = unit_vectors(4096);
  std::vector<float> inputs;
  for (const glm::vec3& n : normals) inputs.insert(inputs.end(), {n.x, n.y, n.z});
  const std::string body = R"(
#include "lib/basis.glsl"
void evaluate(uint index) {
  vec3 n = vec3(inputs[3 * index], inputs[3 * index + 1], inputs[3 * index + 2]);
  vec3 x, y;
  orthonormal_basis(n, x, y);
  for (uint i = 0; i < 3; ++i) {
    outputs[6 * index + i] = x[i];
    outputs[6 * index + 3 + i] = y[i];
  }
})";
  const std::vector<float> out =
      run_snippet(device(), body, inputs, normals.size() * 6, static_cast<uint32_t>(normals.size()));
  for (size_t i = 0; i < normals.size(); ++i) {
    const glm::dvec3 x = vector_at(out, 2 * i);
    const glm::dvec3 y = vector_at(out, 2 * i + 1);
    EXPECT_NEAR(glm::length(x), 1, 1e-5);
    EXPECT_NEAR(glm::length(y), 1, 1e-5);
    EXPECT_NEAR(glm::dot(x, y), 0, 1e-5);
    EXPECT_LT(glm::distance(glm::cross(x, y), glm::dvec3(normals[i])), 2e-5) << "normal " << i;
  }
}

TEST_F(BasisTest, OrthogonalTangentKeepsTheTangentWhereItCanAndIsNeverNaN) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  struct Case {
    glm::vec3 tangent;
    glm::vec3 expected;  // zero: any vector orthogonal to z
  };
  const std::vector<Case> cases = {
      {{3, 0, 7}, {1, 0, 0}}, {{0, -2, 0}, {0, -1, 0}},    {{0, 0, 1}, {}},   {{0, 0, 0}, {}},   {{nan, 0, 0}, {}},
      {{0, 0, -1e20f}, {}},   {{1e-12f, 0, 0}, {1, 0, 0}}, {{nan, 1, 0}, {}}, {{1, nan, 0}, {}}, {{0, 1, nan}, {}}};
  std::vector<float> inputs;
  for (const Case& c : cases) inputs.insert(inputs.end(), {c.tangent.x, c.tangent.y, c.tangent.z});
  const std::string body = R"(
#include "lib/basis.glsl"
void evaluate(uint index) {
  vec3 t = orthogonal_tangent(vec3(0, 0, 1), vec3(inputs[3 * index], inputs[3 * index + 1], inputs[3 * index + 2]));
  for (uint i = 0; i < 3; ++i) outputs[3 * index + i] = t[i];
})";
  const std::vector<float> out =
      run_snippet(device(), body, inputs, cases.size() * 3, static_cast<uint32_t>(cases.size()));
  for (size_t i = 0; i < cases.size(); ++i) {
    const glm::dvec3 t = vector_at(out, i);
    EXPECT_NEAR(glm::length(t), 1, 1e-5) << "case " << i;
    EXPECT_NEAR(t.z, 0, 1e-5) << "case " << i;
    if (cases[i].expected != glm::vec3(0)) {
      EXPECT_LT(glm::distance(t, glm::dvec3(cases[i].expected)), 1e-5) << "case " << i;
    }
  }
}

}  // namespace
}  // namespace lightloom::test
