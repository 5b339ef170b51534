#include <gtest/gtest.h>

#include "tests/passes/light_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

class Upsample : public DeviceTest {};

Images upsample(const scene::Scene& scene, const std::string& pattern, uint32_t view, uint32_t trace) {
  const std::string passes = R"("gather": { "type": "gather" },
    "trace_surface": { "type": "resample_surface", "in": { "surface": "gather.surface" } },
    "pattern": { "type": "pattern", "in": { "surface": "trace_surface.surface" }, "params": { "pattern": ")" +
                             pattern + R"(" } },
    "full": { "type": "pattern", "in": { "surface": "gather.surface" }, "params": { "pattern": ")" +
                             pattern + R"(" } },
    "upsample": { "type": "upsample", "in": { "radiance": "pattern.radiance", "trace_surface": "trace_surface.surface",
                  "surface": "gather.surface" } })";
  GraphRunOptions options;
  options.extra_types = {make_pattern()};
  options.capture = {"gather.surface.position"};
  return run_graph(graph_text(view, view, trace, trace, passes,
                              R"("radiance": "upsample.radiance", "full": "full.radiance", "low": "pattern.radiance")"),
                   scene, options)
      .front();
}

/// A slanted post before a wall, with background around.
scene::Scene post() {
  return make_quad_scene({{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}}, {{-0.4f, -0.8f, 1}, {0.35f, 0, 0}, {0.5f, 1.5f, 0.3f}}},
                         {lambertian(glm::vec3(0.5f))}, look_at({0.2f, 0.1f, 4}, {0, 0, 0}, 0.8f));
}

TEST_F(Upsample, IsTheIdentityAtEqualSizes) {
  const Images images = upsample(post(), "noise", 60, 60);
  int surfaces = 0;
  for (uint32_t y = 0; y < 60; ++y)
    for (uint32_t x = 0; x < 60; ++x) {
      const bool background = images.at("gather.surface.position").at(x, y, 0, 3) <= 0;
      surfaces += background ? 0 : 1;
      for (uint32_t c = 0; c < 4; ++c)
        ASSERT_EQ(images.at("radiance").at(x, y, 0, c), background ? 0 : images.at("low").at(x, y, 0, c));
    }
  EXPECT_GT(surfaces, 300);
}

TEST_F(Upsample, TakesValuesOfTheSameObjectAlone) {
  for (const uint32_t trace : {24u, 32u, 48u}) {
    const Images images = upsample(post(), "object", 96, trace);
    for (uint32_t y = 0; y < 96; ++y)
      for (uint32_t x = 0; x < 96; ++x) {
        if (images.at("gather.surface.position").at(x, y, 0, 3) <= 0) continue;
        ASSERT_EQ(images.at("radiance").at(x, y, 0, 0), images.at("full").at(x, y, 0, 0)) << x << " " << y;
        ASSERT_EQ(images.at("radiance").at(x, y, 0, 1), images.at("full").at(x, y, 0, 1)) << x << " " << y;
      }
  }
}

TEST_F(Upsample, TakesValuesFromNearby) {
  const scene::Scene wall = make_quad_scene({{{-3, -3, 0}, {6, 0, 0}, {0, 6, 0}}}, {lambertian(glm::vec3(0.5f))},
                                            look_at({0.3f, 0.1f, 3}, {0, 0, 0}, 0.8f));
  const Images images = upsample(wall, "ramp", 96, 48);
  for (uint32_t y = 0; y < 96; ++y)
    for (uint32_t x = 0; x < 96; ++x) {
      EXPECT_NEAR(images.at("radiance").at(x, y, 0, 0) * 16, x / 2.0 - 0.25, 1) << x << " " << y;
      EXPECT_NEAR(images.at("radiance").at(x, y, 0, 1) * 16, y / 2.0 - 0.25, 1) << x << " " << y;
    }
}

}  // namespace
}  // namespace lightloom::test
