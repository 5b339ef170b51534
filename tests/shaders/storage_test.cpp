// What images of 16 bits hold (shaders/lib/storage.glsl, the wide form of shaders/lib/voxel_encoding.glsl), against
// formulas in double precision that share no code with the shaders.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "tests/support/device_fixture.hpp"
#include "tests/support/snippet_runner.hpp"

namespace lightloom::test {
namespace {

using StorageShader = DeviceTest;
constexpr double kPi = std::numbers::pi;
constexpr double kDegrees = 180 / kPi;
constexpr float kHalfMax = 65504;

std::vector<float> stored(gpu::Device& device, const std::vector<float>& values, float largest) {
  std::vector<float> inputs = values;
  inputs.push_back(largest);
  const std::string body = R"(
#include "lib/storage.glsl"
void evaluate(uint index) { outputs[index] = storable(vec4(inputs[index], 0.0, 0.0, 0.0), inputs[)" +
                           std::to_string(values.size()) + "]).x; }";
  return run_snippet(device, body, inputs, values.size(), static_cast<uint32_t>(values.size()));
}

TEST_F(StorageShader, AHalfEndsAtItsLargestNumberAndNotAtInfinity) {
  const float inf = std::numeric_limits<float>::infinity();
  const std::vector<float> values = {inf, -inf, 1e30f, -1e30f, 65520, 65505, 65504, -65504, 1, 0, -3e-8f};
  const std::vector<float> expected = {kHalfMax, -kHalfMax, kHalfMax, -kHalfMax, kHalfMax, kHalfMax,
                                       kHalfMax, -kHalfMax, 1,        0,         -3e-8f};
  const std::vector<float> got = stored(device(), values, kHalfMax);
  for (size_t i = 0; i < values.size(); ++i) EXPECT_EQ(got[i], expected[i]) << values[i];
  EXPECT_TRUE(std::isnan(stored(device(), {std::numeric_limits<float>::quiet_NaN()}, kHalfMax).front()));
}

TEST_F(StorageShader, ThirtyTwoBitsStayAsTheyAre) {
  std::mt19937 random(5);
  std::vector<float> values = {std::numeric_limits<float>::infinity(), -0.0f, 3e38f, -65505.0f, 1e-38f};
  for (int i = 0; i < 2000; ++i) {
    const auto value = std::bit_cast<float>(static_cast<uint32_t>(random()));
    if (std::isnormal(value)) values.push_back(value);
  }
  const std::vector<float> got = stored(device(), values, std::numeric_limits<float>::max());
  for (size_t i = 0; i < values.size(); ++i)
    EXPECT_EQ(std::bit_cast<uint32_t>(got[i]), std::bit_cast<uint32_t>(values[i])) << values[i];
}

struct Surface {
  glm::dvec3 normal{0, 1, 0}, tangent{1, 0, 0};
  double handedness = 1, metallic = 0, root_albedo = 0, root_alpha = 0, f0 = 0, emission = 0;
};
constexpr size_t kInputs = 12;
constexpr size_t kOutputs = 12 + 12 + 8;  // wide words, the decoded surface, normal words of 8 bits: recoded and direct

const std::string kBody = R"(
#include "lib/voxel_encoding.glsl"
void evaluate(uint index) {
  uint at = 12 * index;
  VoxelSurface s;
  s.normal = vec3(inputs[at], inputs[at + 1], inputs[at + 2]);
  s.tangent = vec3(inputs[at + 3], inputs[at + 4], inputs[at + 5]);
  s.handedness = inputs[at + 6];
  s.metallic = inputs[at + 7];
  s.albedo = vec3(inputs[at + 8] * inputs[at + 8]);
  s.ward_alpha = vec2(inputs[at + 9] * inputs[at + 9]);
  s.f0 = inputs[at + 10];
  s.f90 = 1.0;
  s.emission = uint(inputs[at + 11]);
  vec4 words[3];
  encode_voxel(s, uvec3(16u), words[0], words[1], words[2]);
  uint o = 32 * index;
  for (uint i = 0; i < 12; ++i) outputs[o + i] = float(from_unorm(words[i / 4][i % 4], 16u));
  VoxelSurface d = decode_voxel(words[0], words[1], words[2], 16u);
  vec4 recoded = recode_voxel_normal(words[1], 16u, 8u);
  vec4 direct = encode_voxel_normal(s, 8u);
  for (uint i = 0; i < 3; ++i) {
    outputs[o + 12 + i] = d.normal[i];
    outputs[o + 15 + i] = d.tangent[i];
  }
  outputs[o + 18] = d.handedness;
  outputs[o + 19] = d.metallic;
  outputs[o + 20] = sqrt(d.albedo.g);
  outputs[o + 21] = sqrt(d.ward_alpha.x);
  outputs[o + 22] = d.f0;
  outputs[o + 23] = float(d.emission);
  for (uint i = 0; i < 4; ++i) {
    outputs[o + 24 + i] = float(from_unorm(recoded[i]));
    outputs[o + 28 + i] = float(from_unorm(direct[i]));
  }
})";

std::vector<std::array<float, kOutputs>> encode(gpu::Device& device, const std::vector<Surface>& surfaces) {
  std::vector<float> inputs;
  for (const Surface& s : surfaces)
    for (const double number : {s.normal.x, s.normal.y, s.normal.z, s.tangent.x, s.tangent.y, s.tangent.z, s.handedness,
                                s.metallic, s.root_albedo, s.root_alpha, s.f0, s.emission})
      inputs.push_back(static_cast<float>(number));
  EXPECT_EQ(inputs.size(), surfaces.size() * kInputs);
  const std::vector<float> out =
      run_snippet(device, kBody, inputs, surfaces.size() * kOutputs, static_cast<uint32_t>(surfaces.size()));
  std::vector<std::array<float, kOutputs>> result(surfaces.size());
  for (size_t i = 0; i < result.size(); ++i) std::copy_n(&out[i * kOutputs], kOutputs, result[i].begin());
  return result;
}

glm::dvec3 at(const std::array<float, kOutputs>& out, size_t first) {
  return {out[first], out[first + 1], out[first + 2]};
}

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * kDegrees;
}

/// The direction in the plane of `normal` that is nearest to `v`.
glm::dvec3 projected(const glm::dvec3& v, const glm::dvec3& normal) {
  return glm::normalize(v - normal * glm::dot(v, normal));
}

/// Random ones and the axes, where the angles of directions are undefined.
std::vector<Surface> surfaces() {
  std::mt19937 random(17);
  std::normal_distribution<double> bell;
  std::uniform_real_distribution<double> unit;
  const auto direction = [&] { return glm::normalize(glm::dvec3(bell(random), bell(random), bell(random))); };
  std::vector<Surface> list;
  for (int axis = 0; axis < 6; ++axis) {
    Surface s;
    s.normal = s.tangent = glm::dvec3(0);
    s.normal[axis / 2] = axis % 2 == 0 ? 1 : -1;
    s.tangent[(axis / 2 + 1) % 3] = 1;
    list.push_back(s);
  }
  for (int i = 0; i < 20000; ++i) {
    Surface s;
    s.normal = direction();
    s.tangent = projected(direction(), s.normal);
    s.handedness = unit(random) < 0.5 ? -1 : 1;
    s.metallic = unit(random);
    s.root_albedo = unit(random);
    s.root_alpha = 0.04 + 0.96 * unit(random);
    s.f0 = 0.25 * unit(random);
    s.emission = std::floor(unit(random) * 255.99);
    list.push_back(s);
  }
  return list;
}

TEST_F(StorageShader, WideVoxelsKeepDirectionsWithinTheirError) {
  const std::vector<Surface> given = surfaces();
  const auto out = encode(device(), given);
  double normal_worst = 0, tangent_worst = 0;
  for (size_t i = 0; i < given.size(); ++i) {
    const glm::dvec3 normal = at(out[i], 12), tangent = at(out[i], 15);
    normal_worst = std::max(normal_worst, angle_between(given[i].normal, normal));
    tangent_worst = std::max(tangent_worst, angle_between(projected(given[i].tangent, normal), tangent));
    EXPECT_NEAR(glm::dot(normal, tangent), 0, 1e-5);
    EXPECT_EQ(out[i][18], given[i].handedness) << i;
  }
  RecordProperty("normal_degrees", std::to_string(normal_worst));
  RecordProperty("tangent_degrees", std::to_string(tangent_worst));
  EXPECT_LT(normal_worst, 0.0035);   // half a step of both angles, 0.0031 degrees, and rounding
  EXPECT_LT(tangent_worst, 0.0062);  // half a step, 0.0055 degrees, and rounding
}

TEST_F(StorageShader, WideVoxelsKeepNumbersToHalfAStep) {
  const std::vector<Surface> given = surfaces();
  const auto out = encode(device(), given);
  const double half_step = 0.55 / 65535;
  for (size_t i = 0; i < given.size(); ++i) {
    EXPECT_NEAR(out[i][19], given[i].metallic, half_step);
    EXPECT_NEAR(out[i][20], given[i].root_albedo, half_step);
    const double least = std::sqrt(1e-3);  // decoded lobes are no sharper
    EXPECT_NEAR(out[i][21], std::max(given[i].root_alpha, least), half_step);
    EXPECT_NEAR(out[i][22], given[i].f0, half_step / 4);
    EXPECT_EQ(out[i][23], given[i].emission);
    EXPECT_EQ(out[i][3], 65535);
    EXPECT_EQ(out[i][11], given[i].emission * 257) << "255ths in either width";
  }
}

TEST_F(StorageShader, WideWordsMeanWhatTheLibrarySays) {
  const std::vector<Surface> given = surfaces();
  const auto out = encode(device(), given);
  for (size_t i = 0; i < given.size(); ++i) {
    const double azimuth = out[i][4] * 2 * kPi / 65536, polar = out[i][5] * kPi / 65534;
    const glm::dvec3 normal(std::sin(polar) * std::sin(azimuth), std::cos(polar), std::sin(polar) * std::cos(azimuth));
    const glm::dvec3 x(std::cos(azimuth), 0, -std::sin(azimuth));
    const auto word = static_cast<uint32_t>(out[i][6]);
    const double angle = (word & 32767u) * 2 * kPi / 32768;
    const glm::dvec3 tangent = std::cos(angle) * x + std::sin(angle) * glm::cross(normal, x);
    EXPECT_LT(glm::distance(normal, at(out[i], 12)), 1e-5);
    EXPECT_LT(glm::distance(tangent, at(out[i], 15)), 1e-5);
    EXPECT_EQ((word & 32768u) != 0, given[i].handedness < 0);
  }
}

TEST_F(StorageShader, AWideNormalBecomesTheNarrowOneOfTheSameSurface) {
  const std::vector<Surface> given = surfaces();
  const auto out = encode(device(), given);
  size_t other = 0;
  for (size_t i = 0; i < given.size(); ++i) {
    const auto turns = static_cast<int>(std::lround(out[i][24] - out[i][28])) & 255;
    const bool near_pole = std::abs(given[i].normal.y) > 0.99;
    EXPECT_TRUE(near_pole || turns <= 1 || turns == 255) << i;
    EXPECT_NEAR(out[i][25], out[i][29], 1) << i;
    EXPECT_NEAR(out[i][27], out[i][31], 1) << i;
    if (i >= 6 && out[i][24] == out[i][28] && out[i][25] == out[i][29]) other += out[i][26] != out[i][30];
  }
  // The same frame: then a tangent differs only where it lay within rounding of the next code.
  EXPECT_LT(static_cast<double>(other), 0.02 * static_cast<double>(given.size()));
}

}  // namespace
}  // namespace lightloom::test
