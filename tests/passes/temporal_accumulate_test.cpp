#include <gtest/gtest.h>

#include "passes/port_rows.hpp"
#include "tests/passes/light_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

constexpr uint32_t kSize = 48;

class TemporalAccumulate : public DeviceTest {};

scene::Scene wall(const scene::Material& material) {
  return make_quad_scene({{{-2, -2, 0}, {4, 0, 0}, {0, 4, 0}}}, {material}, look_at({0.3f, 0.2f, 3}, {0, 0, 0}, 0.8f));
}

scene::Material metal(float roughness) {
  scene::Material material;
  material.metallic = 1;
  material.roughness = roughness;
  return material;
}

std::string temporal(const std::string& pattern, const std::string& position) {
  const std::string passes = R"("gather": { "type": "gather" },
    "pattern": { "type": "pattern", "in": { "surface": "gather.surface" }, "params": { "pattern": ")" +
                             pattern + R"(" } },
    "moved": { "type": "test_displace", "in": { "surface": "gather.surface" } },
    "temporal": { "type": "temporal_accumulate", "in": { "radiance": "pattern.radiance", "surface": "gather.surface",
      "trail": "pattern.radiance@1..9", "trail_position": ")" +
                             position + R"(@1..9", "trail_normal": "gather.surface.normal@1..9" } })";
  return graph_text(kSize, kSize, kSize, kSize, passes,
                    R"("radiance": "temporal.radiance", "current": "pattern.radiance")");
}

/// Position of the surface, moved by a metre towards the viewer in odd frames.
PassType make_test_displace() {
  PassType type;
  type.name = "test_displace";
  type.doc = "Positions that are wrong in odd frames.";
  type.ports = {passes::surface_input("surface", "where the positions come from"),
                passes::image_output_like("position", Format::rgba32_sfloat, "surface", "moved in odd frames")};
  type.reads = FrameState::time;
  type.record = [](PassContext& context) {
    context.dispatch({"test_displace.comp", context.output_extent("position"), {}});
  };
  return type;
}

std::vector<Images> run(const scene::Scene& scene, const std::string& text, uint32_t frames) {
  GraphRunOptions options;
  options.frames = frames;
  options.extra_types = {make_pattern(), make_test_displace()};
  return run_graph(text, scene, options);
}

double variance(const image::HostImage& image) {
  double sum = 0, squares = 0;
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x) {
      sum += image.at(x, y, 0, 0);
      squares += image.at(x, y, 0, 0) * image.at(x, y, 0, 0);
    }
  const double n = kSize * kSize;
  return squares / n - sum / n * (sum / n);
}

TEST_F(TemporalAccumulate, FirstFrameIsTheCurrentOne) {
  const Images first = run(wall(lambertian(glm::vec3(0.5f))), temporal("noise", "gather.surface.position"), 1).front();
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x)
      ASSERT_EQ(first.at("radiance").at(x, y, 0, 0), first.at("current").at(x, y, 0, 0)) << x << " " << y;
}

TEST_F(TemporalAccumulate, LambertianNoiseFallsToATenth) {
  const std::vector<Images> frames =
      run(wall(lambertian(glm::vec3(0.5f))), temporal("noise", "gather.surface.position"), 12);
  for (const uint32_t frame : {0u, 1u, 4u, 9u, 11u}) {
    const double used = std::min<double>(frame + 1.0, 10);
    EXPECT_NEAR(variance(frames[frame].at("radiance")) * used * 12, 1, 0.12) << frame;
    EXPECT_EQ(frames[frame].at("radiance").at(kSize / 2, kSize / 2, 0, 3), used) << frame;
  }
}

TEST_F(TemporalAccumulate, MirrorShowsTheCurrentFrameAlone) {
  const Images last = run(wall(metal(0)), temporal("noise", "gather.surface.position"), 5).back();
  EXPECT_NEAR(variance(last.at("radiance")) * 12, 1, 0.1);
}

TEST_F(TemporalAccumulate, GlossyMetalLiesBetween) {
  const Images last = run(wall(metal(0.7f)), temporal("noise", "gather.surface.position"), 12).back();
  const double gain = 1 / (variance(last.at("radiance")) * 12);
  EXPECT_GT(gain, 2);
  EXPECT_LT(gain, 9);
}

TEST_F(TemporalAccumulate, FramesThatSawAnotherPlaceAreLeftOut) {
  // The pattern is 1 in odd frames, and there the positions are wrong: only the even frames may be used.
  const std::vector<Images> frames = run(wall(lambertian(glm::vec3(0.5f))), temporal("frame", "moved.position"), 9);
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x) ASSERT_EQ(frames[8].at("radiance").at(x, y, 0, 0), 0) << x << " " << y;
  EXPECT_EQ(frames[8].at("radiance").at(kSize / 2, kSize / 2, 0, 3), 5) << "frames 8, 6, 4, 2, 0";
}

TEST_F(TemporalAccumulate, OneSpoiltPixelDoesNotStay) {
  const Images last = run(wall(lambertian(glm::vec3(0.5f))), temporal("spoilt", "gather.surface.position"), 4).back();
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x) {
      if (x == kSize / 2 && y == kSize / 2) continue;
      ASSERT_EQ(last.at("radiance").at(x, y, 0, 0), 1) << x << " " << y;
    }
}

}  // namespace
}  // namespace lightloom::test
