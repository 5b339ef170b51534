// Direct light against closed forms: Siegel and Howell's configuration factors, solid angles, the inverse square.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/tracing.hpp"

namespace lightloom::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr uint32_t kPaths = 60000;

/// A grey floor around the origin that faces up; the pixel looks straight down at one point of it. Emitters face down,
/// so that the viewer looks through their backs.
struct FloorScene {
  SceneBuilder builder;
  uint32_t lamp = 0;

  FloorScene() {
    builder.quad({-50, 0, 50}, {100, 0, 0}, {0, 0, -100}, builder.material(matte(glm::vec3(0.5f))));
    lamp = builder.material(matte(glm::vec3(0), glm::vec3(3)));
  }

  Estimate light(const glm::vec3& point = glm::vec3(0), const TraceOptions& options = {},
                 reference::Strategy strategy = reference::Strategy::mis) {
    const scene::Scene scene = builder.finish(flat_view(point, {0, -1, 0}, 0.001f, {0, 0, -1}));
    return trace_pixel(scene, kPaths, 0, options, reference::WardForm::bounded, strategy);
  }
};

/// Radiance that a floor of reflectance 0.5 sends up under an emitter of radiance 3 that fills the factor `f` of what
/// it sees.
double reflected(double f) {
  return 0.5 * 3 * f;
}

TEST(ReferenceFormFactor, SquareAboveAnElement) {
  FloorScene floor;
  floor.builder.quad({-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1}, floor.lamp);
  expect_agrees(floor.light(), reflected(0.239456470460774), "centred");
  expect_agrees(floor.light({0.5f, 0, 0.5f}), reflected(0.138531605994893), "below a corner");
  expect_agrees(floor.light({0, 0, 0}, {}, reference::Strategy::nee), reflected(0.239456470460774), "by NEE");
  expect_agrees(floor.light({0, 0, 0}, {}, reference::Strategy::bsdf), reflected(0.239456470460774), "by rays");
}

TEST(ReferenceFormFactor, SquarePerpendicularToAnElement) {
  FloorScene floor;
  // From the floor up, one metre away, its corner opposite the element.
  floor.builder.quad({1, 0, 0}, {0, 0, 1}, {0, 1, 0}, floor.lamp);
  expect_agrees(floor.light(), reflected(0.0557341970025535), "perpendicular");
}

TEST(ReferenceFormFactor, SquareToSquare) {
  SceneBuilder builder;
  builder.quad({-0.5f, 0, 0.5f}, {1, 0, 0}, {0, 0, -1}, builder.material(matte(glm::vec3(0.5f))));
  builder.quad({-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1}, builder.material(matte(glm::vec3(0), glm::vec3(3))));
  // One pixel, filtered over the whole lower square.
  const scene::Scene scene = builder.finish(flat_view({0, 0, 0}, {0, -1, 0}, 0.5f, {0, 0, -1}));
  expect_agrees(trace_pixel(scene, kPaths, 0, {.box = true}), reflected(0.199824895698387), "parallel");
}

TEST(ReferenceFormFactor, PerpendicularSquaresWithACommonEdge) {
  SceneBuilder builder;
  builder.quad({0, 0, 1}, {1, 0, 0}, {0, 0, -1}, builder.material(matte(glm::vec3(0.5f))));
  builder.quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, builder.material(matte(glm::vec3(0), glm::vec3(3))));
  const scene::Scene scene = builder.finish(flat_view({0.5f, 0, 0.5f}, {0, -1, 0}, 0.5f, {0, 0, -1}));
  expect_agrees(trace_pixel(scene, kPaths, 0, {.box = true}), reflected(0.200043776075403), "perpendicular");
}

TEST(ReferenceFormFactor, Disc) {
  FloorScene floor;
  constexpr int kCorners = 512;
  const auto rim = [](int i) {
    const double angle = 2 * kPi * i / kCorners;
    return glm::vec3(std::cos(angle), 2, std::sin(angle));
  };
  for (int i = 0; i < kCorners; ++i) floor.builder.triangle({0, 2, 0}, rim(i), rim(i + 1), floor.lamp);
  expect_agrees(floor.light(), reflected(0.2), "disc", 1e-4);
}

TEST(ReferenceFormFactor, Sphere) {
  FloorScene floor;
  constexpr int kColumns = 96, kRows = 48;
  // With as much cross-section as the sphere of radius 1: what an inscribed one lacks is given back.
  const double radius = 1 / std::sqrt(std::sin(2 * kPi / kColumns) / (2 * kPi / kColumns));
  const auto point = [&](int column, int row) {
    const double azimuth = 2 * kPi * column / kColumns, polar = kPi * row / kRows;
    return glm::vec3(glm::dvec3(0, 2, 0) + radius * glm::dvec3(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                                               std::sin(polar) * std::sin(azimuth)));
  };
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      const glm::vec3 a = point(column, row), b = point(column + 1, row), c = point(column, row + 1),
                      d = point(column + 1, row + 1);
      if (row > 0) floor.builder.triangle(a, b, c, floor.lamp);
      if (row + 1 < kRows) floor.builder.triangle(b, d, c, floor.lamp);
    }
  // Beside the viewer's ray, which the sphere would block: the factor is (r / d)^2 times the cosine.
  const double d2 = 4 + 2.25;
  expect_agrees(floor.light({1.5f, 0, 0}), reflected(1 / d2 * 2 / std::sqrt(d2)), "sphere", 2e-3);
}

TEST(ReferenceFormFactor, EvenEnvironment) {
  FloorScene floor;
  floor.builder.scene.environment.radiance = glm::vec3(3);
  expect_agrees(floor.light(), reflected(1), "even environment");
  expect_agrees(floor.light({0, 0, 0}, {}, reference::Strategy::nee), reflected(1), "even environment by NEE");
}

TEST(ReferenceFormFactor, SunOnAPlane) {
  for (const reference::SunModel model : {reference::SunModel::delta, reference::SunModel::disc}) {
    FloorScene floor;
    floor.builder.scene.sun = scene::Sun{glm::normalize(glm::vec3(0.6f, -0.8f, 0)), glm::vec3(5), 0.1f};
    expect_agrees(floor.light({0, 0, 0}, {.sun = model}), 0.5 / kPi * 5 * 0.8, "sun");
  }
}

TEST(ReferenceFormFactor, PointLights) {
  FloorScene floor;
  scene::PunctualLight lamp;
  lamp.intensity = glm::vec3(7);
  lamp.position = {3, 4, 0};
  floor.builder.scene.punctual = {lamp};
  const double alone = 0.5 / kPi * 7 * 0.8 / 25;
  expect_agrees(floor.light(), alone, "point");
  floor.builder.scene.punctual[0].range = 10;
  expect_agrees(floor.light(), alone * (1 - 1.0 / 16), "range");
  floor.builder.scene.punctual[0].range = 0;
  lamp.type = scene::PunctualType::directional;
  lamp.direction = {0, -1, 0};
  floor.builder.scene.punctual.push_back(lamp);
  expect_agrees(floor.light(), alone + 0.5 / kPi * 7, "point and directional");
}

TEST(ReferenceFormFactor, SpotLights) {
  FloorScene floor;
  scene::PunctualLight lamp;
  lamp.type = scene::PunctualType::spot;
  lamp.position = {0, 2, 0};
  lamp.direction = {0, -1, 0};
  lamp.intensity = glm::vec3(7);
  lamp.inner_cone = 0.2f;
  lamp.outer_cone = 0.6f;
  floor.builder.scene.punctual = {lamp};
  expect_agrees(floor.light(), 0.5 / kPi * 7 / 4, "in the inner cone");
  const double squared = 4 + 1, cosine = 2 / std::sqrt(squared);
  const double inside = (cosine - std::cos(0.6)) / (std::cos(0.2) - std::cos(0.6));
  expect_agrees(floor.light({1, 0, 0}), 0.5 / kPi * 7 * cosine / squared * inside * inside, "between the cones");
  EXPECT_EQ(floor.light({2, 0, 0}).mean, 0) << "outside";
}

TEST(ReferenceFormFactor, LightsBehindSomethingGiveNothing) {
  FloorScene floor;
  floor.builder.quad({-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1}, floor.lamp);
  scene::PunctualLight lamp;
  lamp.position = {0.1f, 3, 0};
  floor.builder.scene.punctual = {lamp};
  floor.builder.scene.sun = scene::Sun{{0, -1, 0}, glm::vec3(5), 0};
  floor.builder.quad({-20, 0.5f, -20}, {40, 0, 0}, {0, 0, 40}, floor.builder.material(matte(glm::vec3(0))));
  // The screen faces down; its back hides what is above it from the floor, but not the floor from the viewer.
  EXPECT_EQ(floor.light().mean, 0);
}

}  // namespace
}  // namespace lightloom::test
