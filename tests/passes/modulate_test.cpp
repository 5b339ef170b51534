#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "passes/port_rows.hpp"
#include "tests/passes/light_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

constexpr uint32_t kSize = 32;

class Modulate : public DeviceTest {};

Images modulate(const scene::Scene& scene) {
  const std::string passes = R"("gather": { "type": "gather" },
    "pattern": { "type": "pattern", "in": { "surface": "gather.surface" } },
    "modulate": { "type": "modulate", "in": { "radiance": "pattern.radiance", "surface": "gather.surface" } })";
  GraphRunOptions options;
  options.extra_types = {make_pattern()};
  return run_graph(graph_text(kSize, kSize, kSize, kSize, passes, R"("radiance": "modulate.radiance")"), scene, options)
      .front();
}

/// A test pass: light by the base and by the lobe, as a tracer would give it.
PassType make_test_lobes() {
  PassType type;
  type.name = "test_lobes";
  type.doc = "Known light, divided by the modulation colours.";
  type.ports = {passes::surface_input("surface", "what reflects"),
                passes::image_output_like("radiance", Format::rgba32_sfloat, "surface", "both, divided by the sum"),
                passes::image_output_like("diffuse", Format::rgba32_sfloat, "surface", "by the base"),
                passes::image_output_like("specular", Format::rgba32_sfloat, "surface", "by the lobe"),
                passes::image_output_like("light", Format::rgba32_sfloat, "surface", "both, undivided")};
  type.params = {{"diffuse", ParamType::real, 1.0, {}, {}, {}, "", "light that the base scatters"},
                 {"specular", ParamType::real, 1.0, {}, {}, {}, "", "light that the lobe reflects"}};
  type.reads = FrameState::camera;
  type.record = [](PassContext& context) {
    context.dispatch({"test_lobes.comp", context.output_extent("radiance"), {}});
  };
  return type;
}

/// A quad in the middle of the picture, background around; the pattern is (0.25, 0.5, 2) on it.
scene::Scene quad(const scene::Material& material) {
  return make_quad_scene({{{-0.5f, -0.5f, 0}, {1, 0, 0}, {0, 1, 0}}}, {material}, look_at({0, 0, 3}, {0, 0, 0}, 0.8f));
}

void expect_pixel(const image::HostImage& image, uint32_t x, uint32_t y, const glm::dvec4& expected, double tolerance) {
  for (uint32_t c = 0; c < 4; ++c)
    EXPECT_NEAR(image.at(x, y, 0, c), expected[static_cast<int>(c)], tolerance) << x << " " << y << " channel " << c;
}

TEST_F(Modulate, MultipliesByTheBaseColourAndAddsEmission) {
  scene::Material material = lambertian({0.5f, 0.25f, 0.125f});
  material.emission = {1, 2, 3};
  const Images images = modulate(quad(material));
  expect_pixel(images.at("radiance"), kSize / 2, kSize / 2, {1.125, 2.125, 3.25, 1}, 2e-3);
}

TEST_F(Modulate, UnlitSurfacesShowTheirColour) {
  scene::Material material = lambertian({0.5f, 0.25f, 0.125f});
  material.unlit = true;
  expect_pixel(modulate(quad(material)).at("radiance"), kSize / 2, kSize / 2, {0.5, 0.25, 0.125, 1}, 1e-3);
}

/// The same light once as a whole and once in its two parts, each divided by its own colour; then modulated.
Images modulate_both_ways(const scene::Scene& scene, const glm::dvec2& light) {
  auto number = [](double value) { return std::to_string(value); };
  const std::string passes = R"("gather": { "type": "gather" },
    "split": { "type": "test_lobes", "in": { "surface": "gather.surface" },
               "params": { "diffuse": )" +
                             number(light.x) + R"(, "specular": )" + number(light.y) + R"( } },
    "joint": { "type": "modulate", "in": { "radiance": "split.radiance", "surface": "gather.surface" } },
    "apart": { "type": "modulate", "in": { "radiance": "split.diffuse", "specular": "split.specular",
               "surface": "gather.surface" } })";
  GraphRunOptions options;
  options.extra_types = {make_test_lobes()};
  return run_graph(graph_text(kSize, kSize, kSize, kSize, passes,
                              R"("joint": "joint.radiance", "apart": "apart.radiance", "light": "split.light")"),
                   scene, options)
      .front();
}

TEST_F(Modulate, LobesApartAndTogetherGiveTheSame) {
  scene::Material glossy = lambertian({0.5f, 0.25f, 0.125f});
  glossy.specular_factor = 1;
  glossy.roughness = 0.3f;
  glossy.emission = {0.5f, 0, 0.25f};
  scene::Material metal = glossy;
  metal.metallic = 1;
  scene::Material black = lambertian({0, 0, 0.5f});
  for (const scene::Material& material : {lambertian({0.5f, 0.25f, 0.125f}), glossy, metal, black}) {
    for (const bool specular : {true, false}) {
      scene::Scene scene = quad(material);
      scene.features.specular = specular;
      const Images images = modulate_both_ways(scene, {0.75, specular ? 1.5 : 0.0});
      for (uint32_t y = 0; y < kSize; ++y)
        for (uint32_t x = 0; x < kSize; ++x)
          for (uint32_t c = 0; c < 4; ++c) {
            const double joint = images.at("joint").at(x, y, 0, c);
            ASSERT_NEAR(images.at("apart").at(x, y, 0, c), joint, 1e-6 * std::max(1.0, joint)) << x << " " << y;
            if (c < 3 && images.at("joint").at(x, y, 0, 3) > 0) {
              ASSERT_NEAR(joint, images.at("light").at(x, y, 0, c) + material.emission[static_cast<int>(c)], 1e-3);
            }
          }
    }
  }
}

TEST_F(Modulate, BackgroundShowsTheConstantEnvironment) {
  scene::Scene scene = quad(lambertian(glm::vec3(0.5f)));
  expect_pixel(modulate(scene).at("radiance"), 0, 0, {0, 0, 0, 0}, 0);
  scene.environment.radiance = {3, 2, 1};
  scene.features.environment = true;
  expect_pixel(modulate(scene).at("radiance"), 0, 0, {3, 2, 1, 0}, 1e-6);
}

TEST_F(Modulate, BackgroundShowsTheEnvironmentMapTheRightWayRound) {
  // Rows from +y down, columns from longitude -pi, longitude = atan(z, x): looking along -z, x grows to the right, so
  // the middle of the picture is longitude -pi/2, and the right of it tends to longitude 0.
  scene::Scene scene = quad(lambertian(glm::vec3(0.5f)));
  const uint32_t width = 64, height = 32;
  scene.environment.radiance = glm::vec3(2);
  scene.environment.width = width;
  scene.environment.height = height;
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x) {
      scene.environment.rgb.push_back((static_cast<float>(x) + 0.5f) / width);
      scene.environment.rgb.push_back((static_cast<float>(y) + 0.5f) / height);
      scene.environment.rgb.push_back(1);
    }
  scene.features.environment = scene.features.environment_image = true;
  const Images images = modulate(scene);
  for (const uint32_t x : {0u, 5u, kSize / 2, kSize - 1})
    for (const uint32_t y : {0u, kSize - 2}) {
      const double half = std::tan(0.4);
      const double dx = ((x + 0.5) / kSize * 2 - 1) * half, dy = -((y + 0.5) / kSize * 2 - 1) * half;
      const double longitude = std::atan2(-1.0, dx), polar = std::acos(dy / std::sqrt(1 + dx * dx + dy * dy));
      const double pi = 3.141592653589793;
      expect_pixel(images.at("radiance"), x, y, {2 * (longitude / (2 * pi) + 0.5), 2 * polar / pi, 2, 0}, 1e-2);
    }
}

}  // namespace
}  // namespace lightloom::test
