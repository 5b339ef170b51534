// Whoever finds the light, there is the same amount of it: next event estimation alone, scattered rays alone, and both
// sharing it by either heuristic, are estimates of one integral.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/passes/estimator_support.hpp"
#include "tests/passes/light_scenes.hpp"
#include "tests/passes/light_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

constexpr uint32_t kSize = 48;

const std::string kFaces = R"("faces": { "type": "emissive_faces", "in": { "voxels": "voxelize.voxels" } })";

/// trace_passes with the list of emissive faces.
std::string traced_faces(int resolution, const std::string& params) {
  return R"("voxelize": { "type": "voxelize", "params": { "resolution": )" + std::to_string(resolution) + R"( } },
    "distance": { "type": "distance_transform", "in": { "voxels": "voxelize.voxels" } },
    "gather": { "type": "gather" }, )" +
         kFaces + R"(,
    "trace": { "type": "voxel_path_trace", "in": { "surface": "gather.surface", "voxels": "voxelize.voxels",
               "distance": "distance.distance", "faces": "faces.faces", "power": "faces.power" },
               "params": { )" +
         std::string(params.find("\"nee\":") == std::string::npos ? R"("nee": "voxel_faces", )" : "") + params + " } }";
}

class LightAgreement : public DeviceTest {
 protected:
  static ImageEstimate trace(const scene::Scene& scene, const std::string& params, int resolution = 32,
                             uint32_t frames = 16, uint32_t channel = 1) {
    GraphRunOptions options;
    options.frames = frames;
    const std::string text =
        graph_text(kSize, kSize, kSize, kSize, traced_faces(resolution, params), R"("radiance": "trace.radiance")");
    return image_estimate(run_graph(text, scene, options), "radiance", channel);
  }

  static void expect_strategies_agree(const scene::Scene& scene, const std::string& params) {
    const ImageEstimate both = trace(scene, params + R"(, "strategy": "mis")");
    expect_agreement(both, trace(scene, params + R"(, "strategy": "mis", "heuristic": "power")"), "power heuristic");
    expect_agreement(both, trace(scene, params + R"(, "strategy": "nee")"), "NEE alone");
    expect_agreement(both, trace(scene, params + R"(, "strategy": "bsdf")"), "BSDF alone");
  }
};

scene::Material lamp(const glm::vec3& radiance, bool two_sided) {
  scene::Material material = lambertian(glm::vec3(0.2f));
  material.emission = radiance;
  material.double_sided = two_sided;
  return material;
}

scene::Scene two_lamps(bool two_sided) {
  return lamps_scene(lamp({4, 3, 2}, two_sided), lamp({1, 2, 6}, two_sided));
}

TEST_F(LightAgreement, OneSidedLamps) {
  expect_strategies_agree(two_lamps(false), R"("paths": 4, "bounces": 1)");
}

TEST_F(LightAgreement, TwoSidedLamps) {
  expect_strategies_agree(two_lamps(true), R"("paths": 4, "bounces": 1)");
}

TEST_F(LightAgreement, EveryMarchAndWithPowerOfTheSurface) {
  const scene::Scene scene = two_lamps(false);
  for (const std::string march : {"sphere", "dda"}) {
    const std::string params = R"("paths": 4, "bounces": 0, "emitter_area": "surface", "march": ")" + march + "\"";
    expect_agreement(trace(scene, params + R"(, "strategy": "nee")"), trace(scene, params + R"(, "strategy": "bsdf")"),
                     march);
  }
}

/// Irradiance over pi of unit radiance from a thin strip along x that faces down, by summing over points of it.
double strip_light(const glm::dvec3& receiver, double length, double width, double height) {
  double sum = 0;
  constexpr int kSteps = 64;
  for (int k = 0; k < kSteps; ++k) {
    const glm::dvec3 path = glm::dvec3(length * ((k + 0.5) / kSteps - 0.5), height, 0) - receiver;
    const double squared = glm::dot(path, path);
    sum += length * width / kSteps * path.y * path.y / (squared * squared);
  }
  return sum / std::numbers::pi;
}

TEST_F(LightAgreement, LampNarrowerThanAVoxelKeepsItsPower) {
  // A sixth of a voxel wide, and so low that the floor gets nearly all of the light, whichever faces it leaves by.
  const QuadSpec strip{{-0.5f, 0.3f, -0.005f}, {1, 0, 0}, {0, 0, 0.01f}, 1};
  const scene::Scene scene = make_quad_scene({{{-2, 0, 2}, {4, 0, 0}, {0, 0, -4}}, strip},
                                             {lambertian(glm::vec3(0.5f)), lamp({100, 100, 100}, false)},
                                             look_at({0.01f, 3, 0}, {0, 0, 0}, 1.15f, {0, 0, -1}));
  const auto measured = [&](const std::string& area) {
    GraphRunOptions options;
    options.frames = 1;
    const std::string params = R"("paths": 32, "bounces": 0, "emitter_area": ")" + area + "\"";
    const Images images =
        run_graph(graph_text(kSize, kSize, kSize, kSize, traced_faces(66, params),
                             R"("radiance": "trace.radiance", "position": "gather.surface.position")"),
                  scene, options)[0];
    double sum = 0, expected = 0;
    for (uint32_t y = 0; y < kSize; ++y)
      for (uint32_t x = 0; x < kSize; ++x) {
        const image::HostImage& position = images.at("position");
        const glm::dvec3 p(position.at(x, y, 0, 0), position.at(x, y, 0, 1), position.at(x, y, 0, 2));
        if (std::abs(p.y) > 1e-3) continue;
        sum += images.at("radiance").at(x, y, 0, 1);
        expected += 100 * strip_light(p, 1, 0.01, 0.3);
      }
    return sum / expected;
  };
  EXPECT_NEAR(measured("surface"), 1, 0.15);
  EXPECT_GT(measured("voxels"), 5);
}

TEST_F(LightAgreement, EveryChoiceGivesNumbersAndNearlyTheSameLight) {
  scene::Scene scene = two_lamps(false);
  scene.sun = scene::Sun{glm::normalize(glm::vec3(0.3f, -1, -0.6f)), glm::vec3(5), 0.1f};
  scene.environment.radiance = glm::vec3(0.5f);
  scene.features.sun = scene.features.environment = true;
  const double usual = trace(scene, R"("paths": 4, "bounces": 2)", 32, 2).whole.mean;
  for (const std::string choice :
       {R"("march": "sphere")", R"("start": "sqrt3")", R"("nee": "hints")", R"("emitter_area": "surface")",
        R"("sun": "delta")", R"("ward": "1992")", R"("ward_sampling": "phi_uniform")",
        R"("march": "sphere", "start": "sqrt3", "nee": "hints", "ward": "1992", "ward_sampling": "phi_uniform",
           "regularization": 0)"}) {
    // A value that is not finite would make the mean so.
    const double mean = trace(scene, R"("paths": 4, "bounces": 2, )" + choice, 32, 2).whole.mean;
    EXPECT_NEAR(mean, usual, 0.3 * usual) << choice;
  }
}

TEST_F(LightAgreement, SunDiscOnAGlossyFloor) {
  scene::Scene scene = two_lamps(false);
  scene.materials[1].emission = scene.materials[2].emission = glm::vec3(0);
  scene.features.emissive = false;
  scene.sun = scene::Sun{glm::normalize(glm::vec3(0.3f, -1, -0.6f)), glm::vec3(5), 0.25f};
  scene.features.sun = true;
  expect_strategies_agree(scene, R"("paths": 4, "bounces": 1)");
}

}  // namespace
}  // namespace lightloom::test
