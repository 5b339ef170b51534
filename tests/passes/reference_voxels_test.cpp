// voxel_path_trace against the exact tracing of the same voxels on the host, which shares no code with it: both are
// estimates of one integral.
#include <gtest/gtest.h>

#include <cmath>

#include "framework/base/error.hpp"
#include "tests/passes/estimator_support.hpp"
#include "tests/passes/light_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

constexpr uint32_t kSize = 40;

/// Both tracers on the same first hits and voxels.
std::string both_tracers(const std::string& device_params, const std::string& host_params) {
  return R"("voxelize": { "type": "voxelize", "params": { "resolution": 24 } },
    "distance": { "type": "distance_transform", "in": { "voxels": "voxelize.voxels" } },
    "faces": { "type": "emissive_faces", "in": { "voxels": "voxelize.voxels" } },
    "gather": { "type": "gather" },
    "device": { "type": "voxel_path_trace", "in": { "surface": "gather.surface", "voxels": "voxelize.voxels",
                "distance": "distance.distance", "faces": "faces.faces", "power": "faces.power" },
                "params": { "paths": 8, "march": "cube_exit", "nee": "voxel_faces", "regularization": 0)" +
         device_params + R"( } },
    "host": { "type": "reference_path_trace", "in": { "surface": "gather.surface", "voxels": "voxelize.voxels" },
              "params": { "paths": 8, "geometry": "voxels")" +
         host_params + " } }";
}

class ReferenceVoxels : public DeviceTest {
 protected:
  using Formats = std::vector<std::pair<std::string, std::string>>;
  static void expect_tracers_agree(const scene::Scene& scene, const std::string& params, const Formats& formats = {}) {
    GraphRunOptions options;
    options.link.formats = formats;
    options.frames = 14;
    const std::vector<Images> frames =
        run_graph(graph_text(kSize, kSize, kSize, kSize, both_tracers(params, params),
                             R"("device": "device.radiance", "device_diffuse": "device.diffuse",
                                "device_specular": "device.specular", "host": "host.radiance",
                                "host_diffuse": "host.diffuse", "host_specular": "host.specular")"),
                  scene, options);
    for (const char* part : {"", "_diffuse", "_specular"})
      for (const uint32_t channel : {0u, 2u}) {
        const std::string name = part;
        expect_agreement(image_estimate(frames, "device" + name, channel),
                         image_estimate(frames, "host" + name, channel),
                         params + " " + name + " " + std::to_string(channel));
      }
  }
};

scene::Material painted(const glm::vec3& color) {
  scene::Material material = white_lambertian();
  material.base_color = glm::vec4(color, 1);
  return material;
}

/// A room with a red and a green wall, a turned block and a lamp below the ceiling; open to the viewer.
scene::Scene cornell(bool glossy, bool two_sided_lamp) {
  scene::Material white = painted(glm::vec3(0.75f)), red = painted({0.65f, 0.06f, 0.05f}),
                  green = painted({0.1f, 0.5f, 0.1f}), lamp = painted(glm::vec3(0.3f)), block = white;
  lamp.emission = {9, 7, 4};
  lamp.double_sided = two_sided_lamp;
  if (glossy) {
    white.specular_factor = 1;
    white.roughness = 0.5f;
    white.anisotropy_strength = 0.6f;
    block.metallic = 1;
    block.roughness = 0.55f;
  }
  return make_quad_scene({{{-1, -1, 1}, {2, 0, 0}, {0, 0, -2}, 0},
                          {{-1, 1, -1}, {2, 0, 0}, {0, 0, 2}, 0},
                          {{-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, 0},
                          {{-1, -1, 1}, {0, 0, -2}, {0, 2, 0}, 1},
                          {{1, -1, -1}, {0, 0, 2}, {0, 2, 0}, 2},
                          {{-0.35f, 0.9f, -0.35f}, {0.7f, 0, 0}, {0, 0, 0.7f}, 3},
                          {{-0.5f, -0.9f, 0.1f}, {0.7f, 0, 0.3f}, {0, 0.8f, 0}, 4},
                          {{-0.5f, -0.1f, 0.1f}, {0.7f, 0, 0.3f}, {0.2f, 0, -0.5f}, 4}},
                         {white, red, green, lamp, block}, look_at({0.1f, 0, 3.6f}, {0, -0.05f, 0}, 0.6f));
}

TEST_F(ReferenceVoxels, InACornellBox) {
  expect_tracers_agree(cornell(false, false), R"(, "bounces": 3)");
  expect_tracers_agree(cornell(false, true), R"(, "bounces": 1, "emitter_area": "surface")");
}

TEST_F(ReferenceVoxels, WithGlossySurfaces) {
  for (const char* ward : {"bounded", "1992"})
    expect_tracers_agree(cornell(true, true), std::string(R"(, "bounces": 2, "ward": ")") + ward + "\"");
}

TEST_F(ReferenceVoxels, HoweverTheyAreStored) {
  expect_tracers_agree(cornell(true, true), R"(, "bounces": 2)",
                       {{"voxelize.voxels", "rgba16_unorm"}, {"gather.surface", "rgba32_sfloat"}});
  expect_tracers_agree(cornell(true, true), R"(, "bounces": 2)",
                       {{"voxelize.voxels.normal", "rgba16_unorm"}, {"host.*", "rgba16_sfloat"}});
}

TEST_F(ReferenceVoxels, WhoeverFindsTheLight) {
  for (const char* strategy : {"nee", "bsdf"})
    expect_tracers_agree(cornell(false, true), std::string(R"(, "bounces": 1, "strategy": ")") + strategy + "\"");
}

TEST_F(ReferenceVoxels, UnderSunSkyAndPointLights) {
  scene::Scene scene = cornell(false, false);
  scene.sun = scene::Sun{
      .direction = glm::normalize(glm::vec3(-0.3f, -0.5f, -1)), .irradiance = {4, 4, 3}, .angular_radius = 0.02f};
  scene.environment.radiance = {0.3f, 0.4f, 0.6f};
  scene::PunctualLight light;
  light.position = {0.4f, 0.2f, 0.4f};
  light.intensity = {0.3f, 0.4f, 0.5f};
  scene.punctual = {light};
  scene.features.sun = scene.features.environment = scene.features.punctual = true;
  for (const char* sun : {"disc", "delta"})
    expect_tracers_agree(scene, std::string(R"(, "bounces": 2, "sun": ")") + sun + "\"");
}

TEST_F(ReferenceVoxels, NeedsThem) {
  const std::string passes = R"("trace": { "type": "reference_path_trace", "params": { "geometry": "voxels" } })";
  try {
    static_cast<void>(run_graph(graph_text(8, 8, 8, 8, passes, R"("light": "trace.outgoing")"), cornell(false, false)));
    FAIL() << "missing voxels went unnoticed";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::invalid_input);
    EXPECT_NE(std::string(error.what()).find("the input 'voxels' is not connected"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace lightloom::test
