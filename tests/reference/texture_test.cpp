// Textures: what is looked up, what is cut out, what emits.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "framework/reference/textures.hpp"
#include "tests/support/tracing.hpp"

namespace lightloom::test {
namespace {

constexpr double kPi = std::numbers::pi;

/// Four texels in a row, red 0, 51, 102, 255; two rows alike.
scene::Scene row_of_four(scene::Wrap wrap, bool nearest) {
  scene::Scene scene;
  scene::Image image;
  image.name = "row";
  image.width = 4;
  image.height = 2;
  for (int row = 0; row < 2; ++row)
    for (const uint8_t red : std::initializer_list<uint8_t>{0, 51, 102, 255})
      for (const uint8_t value : {red, uint8_t{7}, uint8_t{0}, uint8_t{255}}) image.rgba.push_back(value);
  scene.images = {image};
  scene::Material material;
  material.metallic_roughness_texture.image = 0;
  material.metallic_roughness_texture.wrap_u = wrap;
  material.metallic_roughness_texture.nearest = nearest;
  scene.materials = {material};
  return scene;
}

float red_at(const scene::Scene& scene, float u) {
  reference::TexturePoint point;
  point.uv[0] = {u, 0.5f};
  return reference::Textures(scene).sample(scene.materials[0].metallic_roughness_texture, false, point).r;
}

TEST(ReferenceTextures, FilterBetweenTexels) {
  const scene::Scene scene = row_of_four(scene::Wrap::repeat, false);
  EXPECT_NEAR(red_at(scene, 0.375f), 0.2f, 1e-6f);    // centre of texel 1
  EXPECT_NEAR(red_at(scene, 0.4375f), 0.25f, 1e-6f);  // a quarter of the way to texel 2
  EXPECT_NEAR(red_at(scene, 0), 0.5f, 1e-6f);         // between the last and the first
  EXPECT_NEAR(red_at(scene, 7.4375f), 0.25f, 1e-5f);
  EXPECT_NEAR(red_at(scene, -0.5625f), 0.25f, 1e-6f);
}

TEST(ReferenceTextures, WrapModes) {
  const scene::Scene clamped = row_of_four(scene::Wrap::clamp, false);
  EXPECT_EQ(red_at(clamped, -3), 0);
  EXPECT_EQ(red_at(clamped, 0.05f), 0);
  EXPECT_EQ(red_at(clamped, 1.7f), 1);
  const scene::Scene mirrored = row_of_four(scene::Wrap::mirror, false);
  for (const float u : {0.07f, 0.4375f, 0.93f}) {
    EXPECT_NEAR(red_at(mirrored, -u), red_at(mirrored, u), 1e-6f);
    EXPECT_NEAR(red_at(mirrored, 2 - u), red_at(mirrored, u), 1e-6f);
    EXPECT_NEAR(red_at(mirrored, 2 + u), red_at(mirrored, u), 1e-6f);
  }
  EXPECT_EQ(red_at(mirrored, 1), 1);
}

TEST(ReferenceTextures, NearestTexel) {
  const scene::Scene scene = row_of_four(scene::Wrap::repeat, true);
  EXPECT_NEAR(red_at(scene, 0.49f), 0.2f, 1e-6f);
  EXPECT_NEAR(red_at(scene, 0.51f), 0.4f, 1e-6f);
  EXPECT_EQ(red_at(scene, -0.01f), 1);
}

TEST(ReferenceTextures, LevelsFollowThePixel) {
  const scene::Scene scene = row_of_four(scene::Wrap::repeat, false);
  reference::TexturePoint point;
  point.uv[0] = {0.25f, 0.5f};
  point.filtered = true;
  const reference::Textures textures(scene);
  const auto red = [&](float step) {
    point.dx[0] = {step, 0};
    return textures.sample(scene.materials[0].metallic_roughness_texture, false, point).r;
  };
  const float fine = red(0.25f);
  EXPECT_NEAR(fine, 0.1f, 1e-6f);
  // Two texels a pixel: the next level has texels 0.1 and 0.7 in it, to eighths of a unit of 255; four: their mean.
  EXPECT_NEAR(red(0.5f), 0.1f, 0.004f);
  EXPECT_NEAR(red(1), 0.4f, 0.004f);
  EXPECT_NEAR(red(0.5f * std::sqrt(2.0f)), (0.1f + 0.4f) / 2, 0.005f);
  EXPECT_NEAR(red(1000), 0.4f, 0.004f);
}

/// A floor under a sun straight above, seen from below a screen with a checkered alpha.
TEST(ReferenceTextures, MaskedScreenHalvesTheLight) {
  SceneBuilder builder;
  scene::Material screen = matte(glm::vec3(0));
  screen.alpha_mode = scene::AlphaMode::mask;
  screen.double_sided = true;
  const uint8_t on = 255, off = 0;
  screen.base_color_texture.image =
      static_cast<int32_t>(builder.image(2, 2, {9, 9, 9, on, 9, 9, 9, off, 9, 9, 9, off, 9, 9, 9, on}));
  screen.base_color_texture.nearest = true;
  builder.quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, builder.material(matte(glm::vec3(0.5f))));
  builder.quad({-1, 1, 1}, {2, 0, 0}, {0, 0, -2}, builder.material(screen), 8);
  builder.scene.sun = scene::Sun{{0, -1, 0}, glm::vec3(4), 0};
  // From below the screen, at a slant that no light takes.
  const scene::Scene scene = builder.finish(perspective({0, 0.5f, 0}, {0, 0, 0}, 1, {0, 0, -1}));
  expect_agrees(trace_pixel(scene, 20000, 0, {.box = true}), 0.5 * 0.5 / kPi * 4, "screen");
}

/// The emitting half of a square is a rectangle: its factor is the sum of those of two rectangles under a corner each.
TEST(ReferenceTextures, HalfOfAnEmitterThatEmits) {
  const auto corner_factor = [](double a, double b) {
    const double ra = std::sqrt(1 + a * a), rb = std::sqrt(1 + b * b);
    return (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb)) / (2 * kPi);
  };
  for (const auto strategy : {reference::Strategy::mis, reference::Strategy::nee, reference::Strategy::bsdf}) {
    SceneBuilder builder;
    builder.quad({-50, 0, 50}, {100, 0, 0}, {0, 0, -100}, builder.material(matte(glm::vec3(0.5f))));
    scene::Material lamp = matte(glm::vec3(0), glm::vec3(6));
    lamp.emissive_texture.image = static_cast<int32_t>(builder.image(2, 1, {188, 188, 188, 255, 0, 0, 0, 255}));
    lamp.emissive_texture.nearest = true;
    // u goes along x: the half with x < 0 emits.
    builder.quad({-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1}, builder.material(lamp));
    const scene::Scene scene = builder.finish(flat_view({0.25f, 0, 0}, {0, -1, 0}, 1e-4f, {0, 0, -1}));
    const double texel = std::pow((188 / 255.0 + 0.055) / 1.055, 2.4);
    const double factor = 2 * (corner_factor(0.75, 0.5) - corner_factor(0.25, 0.5));
    expect_agrees(trace_pixel(scene, 60000, 0, {}, reference::WardForm::bounded, strategy), 0.5 * 6 * texel * factor,
                  "textured emitter");
  }
}

TEST(ReferenceTextures, VertexColorsMultiply) {
  SceneBuilder builder;
  builder.quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, builder.material(matte(glm::vec3(0.5f))));
  for (scene::Vertex& vertex : builder.scene.vertices) vertex.color = vertex.position.x < 0 ? 0xFF000000u : 0xFFFFFFFFu;
  builder.scene.environment.radiance = glm::vec3(1);
  const auto at = [&](float x) {
    return trace_pixel(builder.finish(flat_view({x, 0, 0.3f}, {0, -1, 0}, 1e-4f, {0, 0, -1})), 16, 0);
  };
  expect_agrees(at(-0.5f), 0.5 * 0.25, "a quarter along", 1e-4);
  expect_agrees(at(0.5f), 0.5 * 0.75, "three quarters along", 1e-4);
}

/// What is seen and what is not: backs of single-sided surfaces, unlit ones, emission.
TEST(ReferenceSeen, SidesUnlitAndBackground) {
  SceneBuilder builder;
  scene::Material unlit = matte(glm::vec3(0.25f));
  unlit.unlit = true;
  const uint32_t lamp = builder.material(matte(glm::vec3(0), glm::vec3(3)));
  const uint32_t flat = builder.material(unlit);
  builder.scene.environment.radiance = glm::vec3(0.125f);
  builder.quad({0, 1, 0}, {0, 0, 1}, {1, 0, 0}, lamp);   // faces up
  builder.quad({-1, 1, 0}, {1, 0, 0}, {0, 0, 1}, lamp);  // faces down
  builder.quad({0, 0, -1}, {0, 0, 1}, {1, 0, 0}, flat);
  const scene::Scene scene = builder.finish(flat_view({0, 1, 0}, {0, -1, 0}, 2, {0, 0, -1}));
  reference::ImageSettings settings;
  settings.width = settings.height = 4;
  settings.paths = 2;
  const Traced traced = trace(scene, settings);
  EXPECT_EQ(traced.at(2, 2).outgoing, glm::vec3(3)) << "front of a lamp";
  EXPECT_EQ(traced.at(1, 2).outgoing, glm::vec3(0.125f)) << "through the back of a lamp";
  EXPECT_EQ(traced.at(2, 1).outgoing, glm::vec3(0.25f)) << "unlit";
  EXPECT_EQ(traced.at(2, 1).lit, 0);
  EXPECT_EQ(traced.at(2, 1).covered, 1);
  EXPECT_EQ(traced.at(0, 0).outgoing, glm::vec3(0.125f)) << "background";
  EXPECT_EQ(traced.at(0, 0).covered, 0);
}

TEST(ReferenceSeen, ASceneWithoutTrianglesIsItsSky) {
  SceneBuilder builder;
  builder.scene.environment.radiance = {1, 2, 3};
  const Traced traced = trace(builder.finish(flat_view({0, 1, 0}, {0, -1, 0}, 2, {0, 0, -1})), {});
  EXPECT_EQ(traced.at(0, 0).outgoing, glm::vec3(1, 2, 3));
  EXPECT_EQ(traced.at(0, 0).standard_error, glm::vec3(0));
}

}  // namespace
}  // namespace lightloom::test
