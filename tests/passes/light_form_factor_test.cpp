// Direct light of rectangles by their form factors: E = pi L F, so a Lambertian surface reflects albedo times L F.
// Closed forms from Siegel and Howell, "Thermal Radiation Heat Transfer", and Howell's catalogue (C-11, C-14).
#include <gtest/gtest.h>

#include <cmath>

#include "tests/passes/light_scenes.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kRadiance = 10;

class LightFormFactor : public DeviceTest {};

/// From one rectangle to an equal one opposite, x by y at distance 1.
double parallel_rectangles(double x, double y) {
  const double a = 1 + x * x, b = 1 + y * y;
  return 2 / (kPi * x * y) *
         (std::log(std::sqrt(a * b / (a + b - 1))) + x * std::sqrt(b) * std::atan(x / std::sqrt(b)) +
          y * std::sqrt(a) * std::atan(y / std::sqrt(a)) - x * std::atan(x) - y * std::atan(y));
}

/// From a rectangle of depth w to one of height h upright on the edge that they share, both of length 1.
double upright_rectangles(double w, double h) {
  const double a = 1 + w * w, b = 1 + h * h, c = w * w + h * h;
  const double logarithm = std::log(a * b / (1 + c)) + w * w * std::log(w * w * (1 + c) / (a * c)) +
                           h * h * std::log(h * h * (1 + c) / (b * c));
  return (w * std::atan(1 / w) + h * std::atan(1 / h) - std::sqrt(c) * std::atan(1 / std::sqrt(c)) + logarithm / 4) /
         (kPi * w);
}

/// From an element to the rectangle a by b at distance 1 that faces it, over whose corner it lies.
double element_to_corner(double a, double b) {
  const double u = std::sqrt(1 + a * a), v = std::sqrt(1 + b * b);
  return (a / u * std::atan(b / u) + b / v * std::atan(a / v)) / (2 * kPi);
}

TEST(FormFactor, ClosedFormsGiveKnownValues) {
  EXPECT_NEAR(parallel_rectangles(1, 1), 0.199824895698387, 1e-12);
  EXPECT_NEAR(parallel_rectangles(2, 2), 0.415253283577147, 1e-12);
  EXPECT_NEAR(upright_rectangles(1, 1), 0.200043776075403, 1e-12);
  EXPECT_NEAR(upright_rectangles(2, 1), 0.116426301397681, 1e-12);
  EXPECT_NEAR(parallel_rectangles(1, 1) + 4 * upright_rectangles(1, 1), 1, 1e-12) << "a closed cube";
  EXPECT_NEAR(4 * element_to_corner(0.5, 0.5), 0.239456470460774, 1e-12);
  EXPECT_NEAR(element_to_corner(1, 1), 0.138531605994893, 1e-12);
}

/// A floor of albedo 0.5 with the unit square around the origin filling the image, and a lamp. The camera is between
/// both, so that nothing is in its way.
scene::Scene under(const QuadSpec& lamp, bool two_sided = false) {
  scene::Material emitter = lambertian(glm::vec3(0));
  emitter.emission = glm::vec3(static_cast<float>(kRadiance)) * glm::vec3(0.5f, 1, 2);
  emitter.double_sided = two_sided;
  return make_quad_scene({square_floor(1), lamp}, {lambertian(glm::vec3(0.5f)), emitter},
                         look_at({0, 0.5f, 0}, {0, 0, 0}, static_cast<float>(kPi / 2), {0, 0, -1}));
}

QuadSpec ceiling_lamp(float half_width, float height) {
  return {{-half_width, height, -half_width}, {2 * half_width, 0, 0}, {0, 0, 2 * half_width}, 1};
}

std::vector<Images> sampled(const scene::Scene& scene) {
  return trace_frames(scene,
                      {.params = R"("paths": 16, "bounces": 0, "strategy": "nee")", .resolution = 66, .frames = 16});
}

TEST_F(LightFormFactor, ElementUnderARectangleAndUnderItsCorner) {
  const std::vector<Images> frames = sampled(under(ceiling_lamp(0.5f, 1)));
  // Four pixels around the centre, and each corner's own pixel, 1/64 m from the middle of the floor or its corner.
  SampleMean middle, corner;
  for (const Images& images : frames) {
    middle.add(mean_of(images.at("radiance"), 1, 15, 15, 17, 17));
    double sum = 0;
    for (const uint32_t x : {0u, 31u})
      for (const uint32_t y : {0u, 31u}) sum += images.at("radiance").at(x, y, 0, 1) / 4;
    corner.add(sum);
  }
  EXPECT_NEAR(middle.mean(), kRadiance * 4 * element_to_corner(0.5, 0.5), 3 * middle.error() + 5e-3);
  // Moved inwards by d in both directions, an element lies under the corners of four rectangles.
  const double d = 1.0 / 64;
  const double exact = element_to_corner(d, d) + 2 * element_to_corner(d, 1 - d) + element_to_corner(1 - d, 1 - d);
  EXPECT_NEAR(corner.mean(), kRadiance * exact, 3 * corner.error());
  EXPECT_LT(middle.error() + corner.error(), 0.03 * kRadiance * exact);
}

TEST_F(LightFormFactor, RectangleOppositeAnEqualOne) {
  const std::vector<Images> frames = sampled(under(ceiling_lamp(0.5f, 1)));
  for (const uint32_t channel : {0u, 1u, 2u}) {
    const SampleMean light = frame_estimate(frames, channel);
    const double exact = kRadiance * std::pow(2.0, static_cast<double>(channel) - 1) * parallel_rectangles(1, 1);
    // Averaging over 32 x 32 pixels is a midpoint rule, good to a few parts in ten thousand.
    EXPECT_NEAR(light.mean(), exact, 3 * light.error() + 5e-4 * exact);
    EXPECT_LT(light.error(), 3e-3 * exact);
  }
}

TEST_F(LightFormFactor, RectangleUprightOnASharedEdge) {
  const QuadSpec wall{{-0.5f, 0, 0.5f}, {0, 0, -1}, {0, 1, 0}, 1};  // faces +x
  for (const bool two_sided : {false, true}) {
    const SampleMean light = frame_estimate(sampled(under(wall, two_sided)), 1);
    const double exact = kRadiance * upright_rectangles(1, 1);
    // At the edge the geometry term has no bound and pixels are coarse.
    EXPECT_NEAR(light.mean(), exact, 3 * light.error() + 0.01 * exact) << two_sided;
    EXPECT_LT(light.error(), 0.02 * exact);
  }
}

TEST_F(LightFormFactor, NothingBehindAOneSidedLamp) {
  const QuadSpec turned{{-0.5f, 1, 0.5f}, {1, 0, 0}, {0, 0, -1}, 1};  // faces up
  const std::vector<Images> frames = sampled(under(turned));
  EXPECT_EQ(frame_estimate(frames, 1).mean(), 0);
}

/// A lamp whose voxels are exactly the box over its rectangle: both lie a hundredth of a voxel inside.
scene::Scene under_voxels() {
  constexpr float kVoxel = 1.0f / 32;
  scene::Scene scene = under(ceiling_lamp(0.5f - 0.01f * kVoxel, 1 + 0.01f * kVoxel));
  scene.bounds = {{-1, 0, -1}, {1, 1 + kVoxel, 1}};
  return scene;
}

/// Frames of its light by a strategy, the samples chosen by reservoirs or drawn.
std::vector<Images> voxel_lamp_frames(const std::string& strategy, bool reservoirs) {
  const std::string shared = R"("strategy": ")" + strategy + "\"";
  const std::string choosing = R"("faces": { "type": "emissive_faces", "in": { "voxels": "voxelize.voxels" } },
      "reservoirs": { "type": "light_reservoirs", "in": { "surface": "gather.surface", "voxels": "voxelize.voxels",
                      "faces": "faces.faces" }, "params": { )" +
                               shared + " } }, ";
  const std::string inputs =
      std::string(R"(, "faces": "faces.faces")") + (reservoirs ? R"(, "reservoir": "reservoirs.reservoir")" : "");
  const std::string params =
      R"("paths": 32, "bounces": 0, "nee": "voxel_faces", )" + shared + (reservoirs ? R"(, "reservoir_draws": 1)" : "");
  GraphRunOptions options;
  options.frames = 12;
  return run_graph(graph_text(32, 32, 32, 32, choosing + trace_passes(66, params, inputs),
                              R"("radiance": "trace.radiance", "position": "gather.surface.position")"),
                   under_voxels(), options);
}

/// Mean over the pixels of the floor.
double light_under_voxels(const Images& images) {
  // Rays leave the floor 1.01 voxels above it.
  const double height = 1 - 1.01 / 32;
  double exact = 0;
  for (uint32_t y = 0; y < 32; ++y)
    for (uint32_t x = 0; x < 32; ++x) {
      const glm::dvec3 p = surface_position(images, x, y);
      // The four rectangles that meet over the element.
      for (const double a : {0.5 - p.x, 0.5 + p.x})
        for (const double b : {0.5 - p.z, 0.5 + p.z})
          exact += kRadiance * element_to_corner(a / height, b / height) / (32 * 32);
    }
  return exact;
}

TEST_F(LightFormFactor, VoxelsOfALampAreFoundInFullByEachStrategy) {
  for (const char* strategy : {"mis", "nee", "bsdf"})
    for (const bool reservoirs : {false, true}) {
      const std::vector<Images> frames = voxel_lamp_frames(strategy, reservoirs);
      const double exact = light_under_voxels(frames.front());
      const SampleMean light = frame_estimate(frames, 1);
      EXPECT_NEAR(light.mean(), exact, 3 * light.error() + 2e-4 * exact) << strategy << reservoirs;
      EXPECT_LT(light.error(), 5e-3 * exact) << strategy << reservoirs;
    }
}

}  // namespace
}  // namespace lightloom::test
