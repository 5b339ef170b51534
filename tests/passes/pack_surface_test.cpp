// What `pack_surface` writes, and what comes out of it again.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "passes/bundles.hpp"
#include "passes/port_rows.hpp"
#include "tests/passes/light_support.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/snippet_runner.hpp"

namespace lightloom::test {
namespace {

class PackSurface : public DeviceTest {};

TEST_F(PackSurface, Keeps24BitsOfIdsBesideThePoint) {
  const std::vector<float> ids = {1, 0, 1, 255, 0xFFFFFF, 256, 7, 65535, 8, 65536, 9, 0xFFFFFF, 0xABCDEF, 0x123456};
  const auto count = static_cast<uint32_t>(ids.size() / 2);
  const std::vector<float> out = run_snippet(device(), R"(
#include "lib/packed_surface.glsl"
void evaluate(uint index) {
  SurfacePoint point = SurfacePoint(vec3(0.0, -0.6, -0.8), vec3(-3.0, 2.0, 5.0));
  PackedSurface back = unpack_surface(pack_surface(
      PackedSurface(uint(inputs[2u * index]) + kPackedIds, uint(inputs[2u * index + 1u]) + 3u * kPackedIds, point)));
  outputs[4u * index] = float(back.object);
  outputs[4u * index + 1u] = float(back.material);
  outputs[4u * index + 2u] = back.point.normal.z;
  outputs[4u * index + 3u] = back.point.position.x;
})",
                                             ids, 4 * count, count);
  for (uint32_t i = 0; i < count; ++i) {
    EXPECT_EQ(out[4 * i], ids[2 * i]);
    EXPECT_EQ(out[4 * i + 1], ids[2 * i + 1]);
    EXPECT_NEAR(out[4 * i + 2], -0.8, 0.001);
    EXPECT_NEAR(out[4 * i + 3], -3, 5.0 / 32768);
  }
}

/// See tests/passes/shaders/test_spoilt_surface.comp.
PassType make_spoilt_surface() {
  PassType type;
  type.name = "test_spoilt_surface";
  type.doc = "A G-buffer with numbers that are none.";
  type.ports = {passes::bundle_output("surface", passes::surface_parts(), ExtentRule::view,
                                      Access::compute_storage_write, "spoilt")};
  type.record = passes::one_dispatch("test_spoilt_surface.comp", "surface");
  return type;
}

constexpr uint32_t kWidth = 16;
constexpr uint32_t kHeight = 8;
const glm::vec3 kEye(0.5f, 0.25f, 9);

/// The words of a texel, by the layout that shaders/lib/packed_surface.glsl and packed_point.glsl state.
struct Words {
  uint32_t word[4];

  [[nodiscard]] uint32_t object() const { return word[0] & 0xFFFFFFU; }
  [[nodiscard]] uint32_t material() const { return word[0] >> 24U | (word[3] >> 16U) << 8U; }
  [[nodiscard]] glm::dvec3 normal() const {
    const glm::dvec2 place(static_cast<double>(word[1] & 0xFFFU) / 2047 - 1,
                           static_cast<double>(word[1] >> 12U & 0xFFFU) / 2047 - 1);
    glm::dvec3 n(place, 1 - std::abs(place.x) - std::abs(place.y));
    if (n.z < 0) {
      n.x = std::copysign(1 - std::abs(place.y), place.x);
      n.y = std::copysign(1 - std::abs(place.x), place.y);
    }
    return glm::normalize(n);
  }
  [[nodiscard]] glm::dvec3 from_eye() const {
    const double step = std::ldexp(1.0, static_cast<int>(word[1] >> 24U) - 127) / 32767;
    return step * glm::dvec3(static_cast<int16_t>(word[2] & 0xFFFFU), static_cast<int16_t>(word[2] >> 16U),
                             static_cast<int16_t>(word[3] & 0xFFFFU));
  }
};

Words words_at(const image::HostImage& image, uint32_t x, uint32_t y) {
  Words words{};
  for (uint32_t channel = 0; channel < 4; ++channel)
    words.word[channel] = static_cast<uint32_t>(image.at(x, y, 0, channel));
  return words;
}

void expect_packed(const Words& words, const glm::dvec3& normal) {
  EXPECT_EQ(words.object(), 7U);
  EXPECT_EQ(words.material(), 300U);
  EXPECT_LT(glm::distance(words.normal(), normal), 1e-3);
  EXPECT_LT(glm::distance(glm::dvec3(kEye) + words.from_eye(), glm::dvec3(1, -2, 3)), 1e-3);
}

TEST_F(PackSurface, WhatIsNoNumberIsBackgroundOrADefiniteNormal) {
  const scene::Scene scene = make_quad_scene({{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}}}, {lambertian(glm::vec3(1))},
                                             look_at(kEye, {0, 0, 0}, 0.8f));
  GraphRunOptions options;
  options.extra_types = {make_spoilt_surface()};
  const std::string graph = graph_text(kWidth, kHeight, kWidth, kHeight, R"("s": { "type": "test_spoilt_surface" },
    "p": { "type": "pack_surface", "in": { "surface": "s.surface" } })",
                                       R"("point": "p.point")");
  const Images images = run_graph(graph, scene, options).front();
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      SCOPED_TRACE(std::to_string(x) + " " + std::to_string(y));
      const Words words = words_at(images.at("point"), x, y);
      const bool bad_position = y < 4 && x < 3;
      const bool no_depth = y < 4 && x == 3 && y != 2;  // an infinite depth is one
      const bool bad_normal = y < 4 && x >= 4 && x < 8;
      if (bad_position || no_depth) {
        for (const uint32_t word : words.word) EXPECT_EQ(word, 0U);
      } else {
        expect_packed(words, bad_normal ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 0.6, -0.8));
      }
    }
  }
}

}  // namespace
}  // namespace lightloom::test
