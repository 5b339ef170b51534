// Closed forms of light that is reflected: albedos under an even environment, rooms whose walls all emit.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/shaders/ward_albedo_table.hpp"
#include "tests/support/tracing.hpp"

namespace lightloom::test {
namespace {

/// A plane at `theta` degrees from its normal, azimuth `phi` from its tangent.
scene::Scene tilted_plane(const scene::Material& material, double theta, double phi) {
  SceneBuilder builder;
  builder.scene.environment.radiance = glm::vec3(1);
  builder.quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, builder.material(material));
  const double t = theta * std::numbers::pi / 180, p = phi * std::numbers::pi / 180;
  const glm::vec3 towards(std::sin(t) * std::cos(p), std::cos(t), -std::sin(t) * std::sin(p));
  return builder.finish(flat_view({0, 0, 0}, -towards, 1e-4f, {0.01f, 0.02f, 1}));
}

class ReferenceFurnace : public testing::TestWithParam<reference::WardForm> {};

TEST_P(ReferenceFurnace, AlbedoOfTheLobe) {
  for (const WardAlbedo& row : kWardAlbedos) {
    // At 89 degrees the shading normal is tilted to the viewer, and half of the samples lie below the horizon.
    if (row.theta > 86 || row.ax > row.ay) continue;
    if (row.ax != row.ay && row.phi != 0 && row.phi != 90) continue;
    // KHR_materials_anisotropy widens alpha along the tangent; the table's narrow axis is turned by 90 degrees.
    scene::Material material = white_metal(static_cast<float>(std::sqrt(row.ax)));
    material.anisotropy_strength = static_cast<float>(std::sqrt((row.ay - row.ax) / (1 - row.ax)));
    if (row.ax == 1) material.anisotropy_strength = 0;
    material.anisotropy_rotation = static_cast<float>(std::numbers::pi / 2);
    const Estimate estimate = trace_pixel(tilted_plane(material, row.theta, row.phi), 20000, 0, {}, GetParam());
    expect_agrees(estimate, row.albedo[static_cast<size_t>(GetParam())],
                  "ax " + std::to_string(row.ax) + " ay " + std::to_string(row.ay) + " theta " +
                      std::to_string(row.theta) + " phi " + std::to_string(row.phi),
                  3e-4);
  }
}

INSTANTIATE_TEST_SUITE_P(AllForms, ReferenceFurnace,
                         testing::Values(reference::WardForm::ward_1992, reference::WardForm::dur,
                                         reference::WardForm::bounded));

TEST(ReferenceFurnaceRoom, WhiteLambertianShowsTheEnvironment) {
  expect_agrees(trace_pixel(tilted_plane(matte(glm::vec3(1)), 50, 0), 1000, 0), 1, "white");
  expect_agrees(trace_pixel(tilted_plane(matte(glm::vec3(0.3f)), 50, 0), 1000, 0), 0.3, "grey");
}

TEST(ReferenceFurnaceRoom, MirrorShowsTheEnvironment) {
  expect_agrees(trace_pixel(tilted_plane(white_metal(0), 50, 0), 1000, 0), 1, "mirror");
}

TEST(ReferenceFurnaceRoom, BaseUnderAMirrorReflectsWhatThatLeaves) {
  // Lobe and base of a smooth white dielectric: together all of the light, to the last percent that Shirley's factor
  // is normalised by.
  scene::Material material;
  material.metallic = 0;
  material.roughness = 0;
  expect_agrees(trace_pixel(tilted_plane(material, 60, 0), 200000, 0), 1, "smooth dielectric", 1e-4);
}

/// Every wall emits 1 and reflects 0.8: what leaves it is E (1 - rho^(n + 1)) / (1 - rho) for n times scattered.
TEST(ReferenceFurnaceRoom, EmissiveRoomCountsBounces) {
  for (const uint32_t bounces : {0U, 1U, 3U, 10U, 64U}) {
    for (const auto strategy : {reference::Strategy::mis, reference::Strategy::nee, reference::Strategy::bsdf}) {
      SceneBuilder builder;
      builder.room({-1, -1, -1}, {1, 2, 1.5f}, builder.material(matte(glm::vec3(0.8f), glm::vec3(1))));
      const scene::Scene scene = builder.finish(perspective({0.1f, 0.2f, 0.3f}, {1, 0.5f, 0.2f}, 0.01f, {0, 1, 0}));
      const double expected = (1 - std::pow(0.8, bounces + 2)) / 0.2;
      expect_agrees(trace_pixel(scene, 3000, bounces, {}, reference::WardForm::bounded, strategy), expected,
                    std::to_string(bounces) + " bounces");
    }
  }
}

/// Of any shape: the walls of a thin wedge far from the origin do not leak.
TEST(ReferenceFurnaceRoom, EmissiveWedgeFarAwayDoesNotLeak) {
  SceneBuilder builder;
  const uint32_t wall = builder.material(matte(glm::vec3(0.9f), glm::vec3(1)));
  const glm::vec3 o(40000, -30000, 10000);
  const glm::vec3 a = o, b = o + glm::vec3(100, 0, 0), c = o + glm::vec3(50, 2, 90), d = o + glm::vec3(50, 20, 10);
  builder.triangle(a, b, c, wall);
  builder.triangle(a, d, b, wall);
  builder.triangle(b, d, c, wall);
  builder.triangle(c, d, a, wall);
  for (scene::Material& material : builder.scene.materials) material.double_sided = true;
  const scene::Scene scene =
      builder.finish(perspective(o + glm::vec3(50, 5, 30), o + glm::vec3(50, 8, 10), 0.01f, {0, 0, 1}));
  expect_agrees(trace_pixel(scene, 20000, 20, {}, reference::WardForm::bounded, reference::Strategy::bsdf),
                (1 - std::pow(0.9, 22)) / 0.1, "wedge", 1e-4);
}

/// The tracer has no unit of length of its own.
TEST(ReferenceFurnaceRoom, ScaleChangesNothing) {
  const auto light = [](float scale) {
    SceneBuilder builder;
    builder.quad(glm::vec3(-2, 0, 2) * scale, {4 * scale, 0, 0}, {0, 0, -4 * scale},
                 builder.material(matte(glm::vec3(0.7f))));
    builder.quad(glm::vec3(-0.5f, 1, -0.5f) * scale, {scale, 0, 0}, {0, 0, scale},
                 builder.material(matte(glm::vec3(0.2f), glm::vec3(2))));
    return trace_pixel(builder.finish(flat_view({0, 0, 0}, {0, -1, 0}, 1e-3f * scale, {0, 0, -1})), 4000, 3).mean;
  };
  const double metre = light(1);
  EXPECT_GT(metre, 0.3);
  for (const float scale : {0x1p-20f, 0x1p-10f, 0x1p10f, 0x1p20f})
    EXPECT_NEAR(light(scale), metre, 1e-5 * metre) << scale;
}

}  // namespace
}  // namespace lightloom::test
