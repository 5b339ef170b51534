#include <gtest/gtest.h>

#include <cmath>

#include "tests/passes/light_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

constexpr uint32_t kSize = 65;

/// All four spatial filters, by type and axis, and whether neighbours are judged by what `filter_guide` packs.
struct FilterCase {
  std::string type, axis;
  bool packed = false;
};

class Denoise : public DeviceTest, public ::testing::WithParamInterface<FilterCase> {
 protected:
  void SetUp() override { DeviceTest::SetUp(); }

  static Images filter(const scene::Scene& scene, const std::string& pattern, const FilterCase& filter) {
    const std::string guide = filter.packed ? R"(, "guide": "guide.guide")" : "";
    const std::string passes = R"("gather": { "type": "gather" },
      "guide": { "type": "filter_guide", "in": { "surface": "gather.surface" } },
      "pattern": { "type": "pattern", "in": { "surface": "gather.surface" }, "params": { "pattern": ")" +
                               pattern + R"(" } },
      "filter": { "type": ")" + filter.type +
                               R"(", "in": { "radiance": "pattern.radiance", "surface": "gather.surface")" + guide +
                               R"( },
                  "params": { "axis": ")" +
                               filter.axis + R"(" } })";
    GraphRunOptions options;
    options.extra_types = {make_pattern()};
    options.capture = {"gather.surface.position", "gather.surface.normal"};
    return run_graph(graph_text(kSize, kSize, kSize, kSize, passes,
                                R"("radiance": "filter.radiance", "pattern": "pattern.radiance")"),
                     scene, options)
        .front();
  }
};

scene::Scene wall(const scene::Material& material) {
  return make_quad_scene({{{-3, -3, 0}, {6, 0, 0}, {0, 6, 0}}}, {material}, look_at({0, 0, 3}, {0, 0, 0}, 0.8f));
}

/// A floor and a wall that meet in a right angle, seen together.
scene::Scene corner() {
  return make_quad_scene({{{-3, 0, 3}, {6, 0, 0}, {0, 0, -3}}, {{-3, 0, 0}, {6, 0, 0}, {0, 4, 0}}},
                         {lambertian(glm::vec3(0.5f))}, look_at({0.5f, 2, 4}, {0, 0.3f, 0}, 0.7f));
}

TEST_P(Denoise, KeepsAConstantImage) {
  const Images images = filter(corner(), "constant", GetParam());
  const double expected[] = {0.25, 0.5, 2.0};
  int surfaces = 0;
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x) {
      surfaces += images.at("radiance").at(x, y, 0, 3) > 0 ? 1 : 0;
      for (uint32_t c = 0; c < 3; ++c) ASSERT_NEAR(images.at("radiance").at(x, y, 0, c) / expected[c], 1, 1e-6);
    }
  EXPECT_GT(surfaces, 2000);
}

TEST_P(Denoise, LeavesTheBackgroundAlone) {
  const scene::Scene small = make_quad_scene({{{-0.5f, -0.5f, 0}, {1, 0, 0}, {0, 1, 0}}}, {lambertian(glm::vec3(0.5f))},
                                             look_at({0, 0, 3}, {0, 0, 0}, 0.8f));
  const Images images = filter(small, "ramp", GetParam());
  int checked = 0;
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x) {
      if (images.at("gather.surface.position").at(x, y, 0, 3) > 0) continue;
      ++checked;
      for (uint32_t c = 0; c < 4; ++c)
        ASSERT_EQ(images.at("radiance").at(x, y, 0, c), images.at("pattern").at(x, y, 0, c)) << x << " " << y;
    }
  EXPECT_GT(checked, 1000);
}

TEST_P(Denoise, DoesNotBleedOverAnEdgeBetweenNormals) {
  const Images images = filter(corner(), "normal", GetParam());
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x)
      for (uint32_t c = 0; c < 3; ++c)
        ASSERT_NEAR(images.at("radiance").at(x, y, 0, c), images.at("pattern").at(x, y, 0, c), 1e-6) << x << " " << y;
}

TEST_P(Denoise, DoesNotMixObjects) {
  const scene::Scene coplanar =
      make_quad_scene({{{-3, -3, 0}, {3, 0, 0}, {0, 6, 0}}, {{0, -3, 0}, {3, 0, 0}, {0, 6, 0}}},
                      {lambertian(glm::vec3(0.5f))}, look_at({0, 0, 3}, {0, 0, 0}, 0.8f));
  const Images images = filter(coplanar, "object", GetParam());
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x)
      ASSERT_EQ(images.at("radiance").at(x, y, 0, 0), images.at("pattern").at(x, y, 0, 0)) << x << " " << y;
}

TEST_P(Denoise, SpreadsAnImpulseAlongItsAxisAlone) {
  const Images images = filter(wall(lambertian(glm::vec3(0.5f))), "impulse", GetParam());
  const image::HostImage& radiance = images.at("radiance");
  // On this wall the tangent is the screen's x.
  const bool across = GetParam().axis == "tangent" || GetParam().axis == "x";
  double sum = 0;
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x) {
      const double value = radiance.at(x, y, 0, 0);
      sum += value;
      if ((across ? y : x) != kSize / 2) {
        ASSERT_EQ(value, 0) << x << " " << y;
      }
      const double mirrored = radiance.at(kSize - 1 - x, kSize - 1 - y, 0, 0);
      ASSERT_NEAR(value, mirrored, 1e-6) << x << " " << y;
    }
  EXPECT_NEAR(sum, 1, 1e-5) << "far from edges every kernel has the same length";
  EXPECT_LT(radiance.at(kSize / 2, kSize / 2, 0, 0), 0.25);
}

TEST_P(Denoise, LeavesAMirrorSharp) {
  scene::Material mirror;
  mirror.metallic = 1;
  mirror.roughness = 0;
  const Images images = filter(wall(mirror), "impulse", GetParam());
  EXPECT_EQ(images.at("radiance").at(kSize / 2, kSize / 2, 0, 0), 1);
}

TEST_P(Denoise, OneSpoiltPixelDoesNotSpread) {
  const Images images = filter(wall(lambertian(glm::vec3(0.5f))), "spoilt", GetParam());
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x) {
      if (x == kSize / 2 && y == kSize / 2) continue;
      ASSERT_EQ(images.at("radiance").at(x, y, 0, 0), 1) << x << " " << y;
    }
}

INSTANTIATE_TEST_SUITE_P(Filters, Denoise,
                         ::testing::Values(FilterCase{"denoise_radial", "tangent"},
                                           FilterCase{"denoise_radial", "bitangent"}, FilterCase{"box_blur", "x"},
                                           FilterCase{"box_blur", "y"}, FilterCase{"denoise_radial", "tangent", true},
                                           FilterCase{"denoise_radial", "bitangent", true},
                                           FilterCase{"box_blur", "x", true}, FilterCase{"box_blur", "y", true}),
                         [](const auto& row) {
                           return row.param.type + "_" + row.param.axis + (row.param.packed ? "_packed" : "");
                         });

/// Kernel length of the radial filter along x on a wall at 3 m, in pixels either side.
class DenoiseRadial : public Denoise {};

int reach(const Images& images) {
  int count = 0;
  for (uint32_t x = kSize / 2 + 1; x < kSize; ++x) count += images.at("radiance").at(x, kSize / 2, 0, 0) > 0 ? 1 : 0;
  return count;
}

TEST_F(DenoiseRadial, ReachIsThePromisedLengthTimesTheRoughness) {
  // 65 pixels see 2 * 3 tan(0.4) m: 0.039 m a pixel; a thirtieth of 3 m is 2.56 of them.
  EXPECT_EQ(reach(filter(wall(lambertian(glm::vec3(0.5f))), "impulse", {"denoise_radial", "tangent"})), 2);
  scene::Material brushed;
  brushed.metallic = 1;
  brushed.roughness = 0.3f;
  brushed.anisotropy_strength = 1;  // alpha 1 along the tangent, 0.09 across
  scene::Scene metal = wall(brushed);
  EXPECT_EQ(reach(filter(metal, "impulse", {"denoise_radial", "tangent"})), 2);
  EXPECT_EQ(filter(metal, "impulse", {"denoise_radial", "bitangent"}).at("radiance").at(kSize / 2, kSize / 2, 0, 0), 1);
}

}  // namespace
}  // namespace lightloom::test
