#include <gtest/gtest.h>

#include <algorithm>
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

using VoxelEncodingTest = DeviceTest;
constexpr double kDegrees = 180 / std::numbers::pi;

struct Surface {
  glm::vec3 albedo{0.5f};
  glm::vec3 normal{0, 1, 0};
  glm::vec3 tangent{1, 0, 0};
  float handedness = 1;
  float metallic = 0;
  glm::vec2 alpha{0.5f};
  float f0 = 0.04f;
  float emission = 0;
};
constexpr size_t kSurfaceFloats = 15;
constexpr size_t kOutputs = 12 + 15;  // twelve bytes, then the decoded surface

const std::string kRoundTrip = R"(
#include "lib/voxel_encoding.glsl"
void evaluate(uint index) {
  uint at = 15 * index;
  VoxelSurface s;
  s.albedo = vec3(inputs[at], inputs[at + 1], inputs[at + 2]);
  s.normal = vec3(inputs[at + 3], inputs[at + 4], inputs[at + 5]);
  s.tangent = vec3(inputs[at + 6], inputs[at + 7], inputs[at + 8]);
  s.handedness = inputs[at + 9];
  s.metallic = inputs[at + 10];
  s.ward_alpha = vec2(inputs[at + 11], inputs[at + 12]);
  s.f0 = inputs[at + 13];
  s.f90 = 1.0;
  s.emission = uint(inputs[at + 14]);
  vec4 words[3];
  encode_voxel(s, uvec3(8u), words[0], words[1], words[2]);
  uint o = 27 * index;
  for (uint i = 0; i < 12; ++i) outputs[o + i] = float(from_unorm(words[i / 4][i % 4]));
  VoxelSurface d = decode_voxel(words[0], words[1], words[2], 8u);
  o += 12;
  for (uint i = 0; i < 3; ++i) {
    outputs[o + i] = d.albedo[i];
    outputs[o + 3 + i] = d.normal[i];
    outputs[o + 6 + i] = d.tangent[i];
  }
  outputs[o + 9] = d.handedness;
  outputs[o + 10] = d.metallic;
  outputs[o + 11] = d.ward_alpha.x;
  outputs[o + 12] = d.ward_alpha.y;
  outputs[o + 13] = d.f0;
  outputs[o + 14] = float(d.emission);
})";

struct Decoded {
  std::array<uint32_t, 12> bytes{};
  Surface surface;
};

std::vector<Decoded> round_trip(gpu::Device& device, const std::vector<Surface>& surfaces) {
  std::vector<float> inputs;
  for (const Surface& s : surfaces) {
    inputs.insert(inputs.end(),
                  {s.albedo.x, s.albedo.y, s.albedo.z, s.normal.x, s.normal.y, s.normal.z, s.tangent.x, s.tangent.y,
                   s.tangent.z, s.handedness, s.metallic, s.alpha.x, s.alpha.y, s.f0, s.emission});
  }
  EXPECT_EQ(inputs.size(), surfaces.size() * kSurfaceFloats);
  const std::vector<float> out =
      run_snippet(device, kRoundTrip, inputs, surfaces.size() * kOutputs, static_cast<uint32_t>(surfaces.size()));
  std::vector<Decoded> result(surfaces.size());
  for (size_t i = 0; i < surfaces.size(); ++i) {
    const float* at = &out[i * kOutputs];
    for (size_t b = 0; b < 12; ++b) result[i].bytes[b] = static_cast<uint32_t>(at[b]);
    at += 12;
    result[i].surface = {{at[0], at[1], at[2]},
                         {at[3], at[4], at[5]},
                         {at[6], at[7], at[8]},
                         at[9],
                         at[10],
                         {at[11], at[12]},
                         at[13],
                         at[14]};
  }
  return result;
}

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * kDegrees;
}

glm::dvec3 projected(const glm::dvec3& v, const glm::dvec3& normal) {
  return glm::normalize(v - normal * glm::dot(v, normal));
}

std::vector<Surface> random_surfaces(size_t count) {
  std::mt19937 random(11);
  std::normal_distribution<float> normal;
  std::uniform_real_distribution<float> unit;
  std::vector<Surface> result(count);
  for (Surface& s : result) {
    s.albedo = {unit(random), unit(random), unit(random)};
    s.normal = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
    s.tangent = glm::vec3(
        projected(glm::dvec3(normal(random), normal(random), normal(random)), glm::normalize(glm::dvec3(s.normal))));
    s.handedness = unit(random) < 0.5f ? -1.0f : 1.0f;
    s.metallic = unit(random);
    s.alpha = {0.002f + 0.998f * unit(random), 0.002f + 0.998f * unit(random)};
    s.f0 = 0.25f * unit(random);
    s.emission = std::floor(unit(random) * 255.99f);
  }
  return result;
}

/// Normal and tangent as passes/bundles.hpp and the paper describe the bytes, in double precision.
struct Frame {
  glm::dvec3 normal, tangent, bitangent;
};
Frame frame_of(const std::array<uint32_t, 12>& bytes) {
  const double azimuth = bytes[4] * 2 * std::numbers::pi / 256;
  const double polar = bytes[5] * std::numbers::pi / 254;
  const glm::dvec3 normal(std::sin(polar) * std::sin(azimuth), std::cos(polar), std::sin(polar) * std::cos(azimuth));
  const glm::dvec3 x(std::cos(azimuth), 0, -std::sin(azimuth));
  const glm::dvec3 y = glm::cross(normal, x);
  const double along = (bytes[6] & 63u) / 31.5 - 1;
  const double across = std::sqrt(1 - along * along) * ((bytes[6] & 64u) != 0 ? -1 : 1);
  const glm::dvec3 tangent = along * x + across * y;
  glm::dvec3 bitangent = glm::cross(normal, tangent);
  const bool away = (bytes[6] & 128u) != 0;
  if ((glm::dot(bitangent, y) < 0) != away) bitangent = -bitangent;
  return {normal, tangent, bitangent};
}

TEST_F(VoxelEncodingTest, NormalsAndTangentsStayWithinThePapersError) {
  const std::vector<Surface> surfaces = random_surfaces(40000);
  const std::vector<Decoded> decoded = round_trip(device(), surfaces);
  double normal_sum = 0, normal_worst = 0, tangent_sum = 0, tangent_worst = 0;
  for (size_t i = 0; i < surfaces.size(); ++i) {
    const glm::dvec3 normal(decoded[i].surface.normal);
    const glm::dvec3 tangent(decoded[i].surface.tangent);
    EXPECT_NEAR(glm::length(normal), 1, 1e-5);
    EXPECT_NEAR(glm::length(tangent), 1, 1e-5);
    EXPECT_NEAR(glm::dot(normal, tangent), 0, 1e-5);
    EXPECT_EQ(decoded[i].surface.handedness, surfaces[i].handedness) << i;
    const double normal_error = angle_between(glm::dvec3(surfaces[i].normal), normal);
    const double tangent_error = angle_between(projected(glm::dvec3(surfaces[i].tangent), normal), tangent);
    normal_sum += normal_error;
    tangent_sum += tangent_error;
    normal_worst = std::max(normal_worst, normal_error);
    tangent_worst = std::max(tangent_worst, tangent_error);
  }
  const auto count = static_cast<double>(surfaces.size());
  EXPECT_LT(normal_worst, 0.79);
  EXPECT_LT(normal_sum / count, 0.36);
  EXPECT_LT(tangent_worst, 10.3);
  EXPECT_LT(tangent_sum / count, 1.35);
}

TEST_F(VoxelEncodingTest, BytesMeanWhatTheBundleSays) {
  const std::vector<Surface> surfaces = random_surfaces(5000);
  const std::vector<Decoded> decoded = round_trip(device(), surfaces);
  for (size_t i = 0; i < surfaces.size(); ++i) {
    const Frame expected = frame_of(decoded[i].bytes);
    const Surface& got = decoded[i].surface;
    EXPECT_LT(glm::distance(expected.normal, glm::dvec3(got.normal)), 1e-3);
    EXPECT_LT(glm::distance(expected.tangent, glm::dvec3(got.tangent)), 1e-3);
    const glm::dvec3 bitangent = glm::cross(glm::dvec3(got.normal), glm::dvec3(got.tangent)) * double(got.handedness);
    EXPECT_LT(glm::distance(expected.bitangent, bitangent), 2e-3);
  }
}

TEST_F(VoxelEncodingTest, ScalarsAreRoundedToTheNearestCode) {
  const std::vector<Surface> surfaces = random_surfaces(20000);
  const std::vector<Decoded> decoded = round_trip(device(), surfaces);
  constexpr double kHalfStep = 0.5 / 255 + 1e-6;
  for (size_t i = 0; i < surfaces.size(); ++i) {
    const Surface& in = surfaces[i];
    const Surface& out = decoded[i].surface;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(std::sqrt(out.albedo[c]), std::sqrt(in.albedo[c]), kHalfStep);
    for (int c = 0; c < 2; ++c) EXPECT_NEAR(std::sqrt(out.alpha[c]), std::sqrt(in.alpha[c]), kHalfStep);
    EXPECT_NEAR(out.metallic, in.metallic, kHalfStep);
    EXPECT_NEAR(out.f0, in.f0, 0.25 * kHalfStep);
    EXPECT_EQ(out.emission, in.emission);
    EXPECT_EQ(decoded[i].bytes[3], 255u);
  }
}

TEST_F(VoxelEncodingTest, AxisDirectionsAreExact) {
  std::vector<Surface> surfaces;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      Surface s;
      s.normal = glm::vec3(0);
      s.normal[axis] = side;
      s.tangent = glm::vec3(0);
      s.tangent[(axis + 1) % 3] = 1;
      surfaces.push_back(s);
    }
  }
  const std::vector<Decoded> decoded = round_trip(device(), surfaces);
  for (size_t i = 0; i < surfaces.size(); ++i)
    EXPECT_LT(angle_between(glm::dvec3(surfaces[i].normal), glm::dvec3(decoded[i].surface.normal)), 0.06) << i;
}

TEST_F(VoxelEncodingTest, BadInputGivesFiniteUnitFrames) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  std::vector<Surface> surfaces(8);
  surfaces[0].normal = glm::vec3(0);
  surfaces[1].normal = glm::vec3(nan);
  surfaces[2].normal = {inf, 0, 0};
  surfaces[3].tangent = glm::vec3(0);
  surfaces[4].tangent = surfaces[4].normal;
  surfaces[5].tangent = glm::vec3(nan, inf, -inf);
  surfaces[6].albedo = glm::vec3(-1, nan, 1e30f);
  surfaces[6].alpha = {nan, -2};
  surfaces[6].f0 = 9;
  surfaces[6].metallic = nan;
  surfaces[7].emission = 300;
  const std::vector<Decoded> decoded = round_trip(device(), surfaces);
  for (size_t i = 0; i < surfaces.size(); ++i) {
    const Surface& out = decoded[i].surface;
    EXPECT_NEAR(glm::length(glm::dvec3(out.normal)), 1, 1e-5) << i;
    EXPECT_NEAR(glm::length(glm::dvec3(out.tangent)), 1, 1e-5) << i;
    EXPECT_NEAR(glm::dot(glm::dvec3(out.normal), glm::dvec3(out.tangent)), 0, 1e-5) << i;
  }
  const Surface& clamped = decoded[6].surface;
  EXPECT_EQ(clamped.albedo, glm::vec3(0, 0, 1));
  EXPECT_FLOAT_EQ(clamped.alpha.x, 1e-3f);
  EXPECT_FLOAT_EQ(clamped.alpha.y, 1e-3f);
  EXPECT_EQ(clamped.f0, 0.25f);
  EXPECT_EQ(clamped.metallic, 0.0f);
  EXPECT_EQ(decoded[7].surface.emission, 255.0f);
}

TEST_F(VoxelEncodingTest, EveryCodeDecodesToAFrameAndEncodesToItself) {
  // All 65536 normals, each with some of the 256 tangent codes.
  const std::string body = R"(
#include "lib/voxel_encoding.glsl"
void evaluate(uint index) {
  uvec2 code = uvec2(index & 255u, index >> 8);
  uint tangent_code = (index * 37u + (index >> 8) * 11u) & 255u;
  vec3 normal, x, y, tangent;
  float handedness;
  decode_normal_frame(code, 8u, normal, x, y);
  decode_tangent(tangent_code, 8u, x, y, tangent, handedness);
  float worst = max(abs(dot(normal, normal) - 1.0), max(abs(dot(x, x) - 1.0), abs(dot(tangent, tangent) - 1.0)));
  worst = max(worst, max(length(cross(x, y) - normal), abs(dot(tangent, normal))));
  outputs[3 * index] = worst;
  outputs[3 * index + 1] = encode_normal(normal, 8u) == code ? 1.0 : 0.0;
  outputs[3 * index + 2] = encode_tangent(code, 8u, tangent, handedness) == tangent_code ? 1.0 : 0.0;
})";
  const std::vector<float> out = run_snippet(device(), body, {}, 3 * 65536, 65536);
  for (uint32_t index = 0; index < 65536; ++index) {
    const uint32_t polar = index >> 8;
    const uint32_t shadow = (index * 37u + polar * 11u) & 63u;
    EXPECT_LT(out[3 * index], 1e-5f) << "normal code " << index;
    // At a pole every azimuth is the same direction; 255 is no polar angle.
    if (polar > 0 && polar < 254) {
      EXPECT_EQ(out[3 * index + 1], 1.0f) << "normal code " << index;
    }
    // At the ends of the shadow the tangent has no part along Y, so that bit means nothing.
    if (shadow > 0 && shadow < 63) {
      EXPECT_EQ(out[3 * index + 2], 1.0f) << "normal code " << index;
    }
  }
}

}  // namespace
}  // namespace lightloom::test
