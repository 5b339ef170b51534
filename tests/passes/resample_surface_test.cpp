#include <gtest/gtest.h>

#include "passes/bundles.hpp"
#include "tests/passes/voxel_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

using ResampleSurfaceTest = DeviceTest;

scene::Scene busy_scene() {
  const glm::mat3 turned(0.8f, 0, 0.6f, 0.36f, 0.8f, -0.48f, -0.48f, 0.6f, 0.64f);
  scene::Scene scene = make_triangle_scene(
      cube_triangles(1, turned), {plain({1, 0.5f, 0.25f}), plain({0.1f, 0.2f, 0.3f}), plain({0.7f, 0.8f, 0.9f})});
  scene.cameras = {look_at({0.5f, 1, 4}, {0, 0, 0}, 0.8f)};
  return scene;
}

Images resample(uint32_t width, uint32_t height, bool enabled = true) {
  const std::string text = R"({ "lightloom": 1, "name": "test", "view": { "width": 61, "height": 47 }, "trace": {
    "width": )" + std::to_string(width) +
                           R"(, "height": )" + std::to_string(height) + R"( }, "passes": {
      "g": { "type": "gather" },
      "r": { "type": "resample_surface", "in": { "surface": "g.surface" }, "enabled": )" +
                           (enabled ? "true" : "false") + R"( } }, "outputs": { "output": "r.surface.albedo" } })";
  GraphRunOptions options;
  options.capture = {"*"};
  return run_graph(text, busy_scene(), options).back();
}

TEST_F(ResampleSurfaceTest, TakesTheTexelUnderEachPixelsCentre) {
  for (const auto& [width, height] : {std::pair{61u, 47u}, {30u, 24u}, {17u, 5u}, {122u, 95u}, {1u, 1u}}) {
    SCOPED_TRACE(std::to_string(width) + "x" + std::to_string(height));
    const Images images = resample(width, height);
    for (const PortPart& part : passes::surface_parts()) {
      const image::HostImage& from = images.at("g.surface." + part.name);
      const image::HostImage& to = images.at("r.surface." + part.name);
      ASSERT_EQ(to.desc.extent, (Extent3{width, height, 1}));
      for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x) {
          const auto source_x = static_cast<uint32_t>((x + 0.5) * 61 / width);
          const auto source_y = static_cast<uint32_t>((y + 0.5) * 47 / height);
          for (uint32_t channel = 0; channel < format_info(part.format).channels; ++channel)
            ASSERT_EQ(to.at(x, y, 0, channel), from.at(source_x, source_y, 0, channel)) << part.name;
        }
      }
    }
  }
}

TEST_F(ResampleSurfaceTest, AtEqualSizeItIsTheIdentityAndDisabledToo) {
  const Images same = resample(61, 47);
  for (const PortPart& part : passes::surface_parts())
    EXPECT_TRUE(same.at("g.surface." + part.name).texels == same.at("r.surface." + part.name).texels) << part.name;
  const Images disabled = resample(30, 20, false);
  EXPECT_TRUE(disabled.at("output").texels == disabled.at("g.surface.albedo").texels);
}

}  // namespace
}  // namespace lightloom::test
