// Whoever finds the light, and whoever traces it, there is the same amount of it.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "tests/passes/estimator_support.hpp"
#include "tests/passes/light_scenes.hpp"
#include "tests/passes/voxel_support.hpp"
#include "tests/ray_query/ray_query_support.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::test {
namespace {

class RayQueryAgreement : public RayQueryTest {
 protected:
  static ImageEstimate estimate_of(const scene::Scene& scene, const std::string& params, uint32_t frames,
                                   const std::string& type = "ray_query_path_trace", uint32_t seed = 1) {
    return image_estimate(
        trace_rays(scene, {.params = params, .bounces = {2}, .type = type, .size = 48, .frames = frames, .seed = seed}),
        "radiance", 2);
  }
  /// Against the reference, which shares no code with the shaders.
  static void expect_reference(const scene::Scene& scene, const std::string& what, uint32_t frames = 16) {
    const ImageEstimate device = estimate_of(scene, R"("paths": 8, "regularization": 0)", frames);
    expect_agreement(device, estimate_of(scene, R"("paths": 24)", frames, "reference_path_trace", 5), what);
  }
};

/// Two lamps of different radiance, one of which shines from both sides.
scene::Scene two_lamps() {
  scene::Material one = lamp_material({4, 3, 2}), other = lamp_material({1, 2, 6}, true);
  one.base_color = other.base_color = glm::vec4(0.2f, 0.2f, 0.2f, 1);
  return lamps_scene(one, other);
}

TEST_F(RayQueryAgreement, StrategiesAndHeuristics) {
  const scene::Scene scene = two_lamps();
  const std::string params = R"("paths": 8, "regularization": 0, "strategy": )";
  const ImageEstimate both = estimate_of(scene, params + R"("mis")", 16);
  expect_agreement(both, estimate_of(scene, params + R"("mis", "heuristic": "power")", 16), "power heuristic");
  expect_agreement(both, estimate_of(scene, params + R"("nee")", 16), "NEE alone");
  expect_agreement(both, estimate_of(scene, params + R"("bsdf")", 16), "BSDF alone");
}

TEST_F(RayQueryAgreement, ReferenceUnderLamps) {
  expect_reference(two_lamps(), "lamps");
}

/// An image whose left half is cut out and whose rest is a pattern of colours. Only black and white, since lavapipe
/// turns the sRGB values between them into light with errors of up to two percent.
scene::Image pattern(bool srgb) {
  return make_image(
      8, 8,
      [](uint32_t x, uint32_t y) {
        const bool even = (x ^ y) % 2 == 0, holes = x < 4;
        return std::array<uint8_t, 4>{static_cast<uint8_t>(even ? 255 : 0), static_cast<uint8_t>(y < 4 ? 255 : 0), 255,
                                      static_cast<uint8_t>(holes ? 0 : 255)};
      },
      srgb);
}

/// A textured screen with holes before a textured, glossy wall, under a disc of a sun, a sky and a bulb.
scene::Scene screen_scene() {
  scene::Material screen = lambertian(glm::vec3(0.7f));
  screen.base_color_texture.image = 0;
  screen.base_color_texture.nearest = true;
  screen.alpha_mode = scene::AlphaMode::mask;
  screen.double_sided = true;
  scene::Material wall = glossy_floor();
  wall.base_color_texture.image = 1;
  wall.metallic = 0.5f;
  const std::vector<QuadSpec> quads = {{{-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 1},
                                       {{-2, 0, -1}, {4, 0, 0}, {0, 2.5f, 0}, 1},
                                       {{-1, 0.1f, 0}, {2, 0, 0}, {0, 1.2f, 0.4f}, 0}};
  scene::Scene scene = make_quad_scene(quads, {screen, wall}, look_at({1.2f, 1.6f, 2.6f}, {0, 0.5f, 0}, 0.9f));
  scene.images = {pattern(true), pattern(true)};
  scene.sun = scene::Sun{glm::normalize(glm::vec3(-0.4f, -1, -0.5f)), glm::vec3(4, 5, 6), 0.2f};
  scene.environment.radiance = glm::vec3(0.5f, 0.6f, 0.7f);
  scene::PunctualLight bulb;
  bulb.intensity = glm::vec3(2);
  bulb.position = {0.8f, 1.5f, 0.9f};
  scene.punctual = {bulb};
  scene.features.sun = scene.features.environment = scene.features.punctual = true;
  scene.features.textured = scene.features.alpha = true;
  return scene;
}

TEST_F(RayQueryAgreement, ReferenceThroughATexturedScreenWithHoles) {
  expect_reference(screen_scene(), "screen");
}

/// A floor under a lamp of bright and black texels.
scene::Scene textured_lamp_scene() {
  scene::Material lamp = lamp_material(glm::vec3(6));
  lamp.emissive_texture.image = 0;
  lamp.emissive_texture.nearest = true;
  scene::Scene scene = make_quad_scene({square_floor(2), {{-1, 0.8f, -1}, {2, 0, 0}, {0, 0, 2}, 1}},
                                       {lambertian(glm::vec3(0.5f)), lamp}, look_at({0, 0.7f, 2.6f}, {0, 0, 0}, 0.8f));
  scene.images = {pattern(true)};
  scene.features.textured = true;
  return scene;
}

TEST_F(RayQueryAgreement, ReferenceUnderATexturedLamp) {
  const scene::Scene scene = textured_lamp_scene();
  const ImageEstimate reference = estimate_of(scene, R"("paths": 32)", 16, "reference_path_trace", 5);
  const std::string params = R"("paths": 16, "regularization": 0, "strategy": )";
  expect_agreement(estimate_of(scene, params + R"("bsdf")", 16), reference, "scattered rays");
  // How much of the lamp emits is estimated from 256 points, and hints are drawn by that.
  EXPECT_NEAR(estimate_of(scene, params + R"("nee")", 16).whole.mean, reference.whole.mean,
              0.02 * reference.whole.mean);
}

TEST_F(RayQueryAgreement, ReferenceInTheCornellBox) {
  const std::filesystem::path file =
      source_dir() / "../shared/scenes/cornell_box_original_emissive/scene_lambertian.gltf";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is missing";
  expect_reference(scene::load_scene(file), "Cornell box");
}

TEST_F(RayQueryAgreement, EveryRunHasTheSameBits) {
  const scene::Scene scene = screen_scene();
  const RaySettings settings{.params = R"("paths": 2, "regularization": 0)", .bounces = {2}, .size = 48, .frames = 2};
  const std::vector<Images> first = trace_rays(scene, settings), second = trace_rays(scene, settings);
  for (size_t frame = 0; frame < 2; ++frame)
    EXPECT_EQ(first[frame].at("radiance").texels, second[frame].at("radiance").texels);
  EXPECT_NE(first[0].at("radiance").texels, first[1].at("radiance").texels);
}

}  // namespace
}  // namespace lightloom::test
