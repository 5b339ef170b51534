// Two implementations of one reflection under every kind of light: where voxels hide nothing, the voxel tracer's
// shaders and the reference tracer on the host must give the same.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/passes/light_scenes.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

constexpr uint32_t kSize = 14;

struct Surface {
  const char* name;
  float metallic, roughness, anisotropy;
};

class ReferenceAgreement : public DeviceTest, public testing::WithParamInterface<Surface> {};

/// A floor alone, so that nothing but the lights reaches it: sun, sky and a point light.
scene::Scene lit_floor(const Surface& surface) {
  scene::Material material;
  material.base_color = {0.8f, 0.5f, 0.3f, 1};
  material.metallic = surface.metallic;
  material.roughness = surface.roughness;
  material.anisotropy_strength = surface.anisotropy;
  material.anisotropy_rotation = 0.6f;
  material.double_sided = true;
  scene::Scene scene = make_quad_scene({square_floor(1)}, {material}, look_at({0.3f, 1.1f, 1.9f}, {0, 0, 0}, 0.5f));
  scene.sun = scene::Sun{glm::normalize(glm::vec3(0.2f, -1, -0.9f)), glm::vec3(2, 1.5f, 1), 0.15f};
  scene.environment.radiance = glm::vec3(0.5f);
  scene.environment.width = 16;
  scene.environment.height = 8;
  for (int texel = 0; texel < 16 * 8; ++texel)
    for (const float channel : {1.0f, 0.8f, 1.3f}) scene.environment.rgb.push_back(channel * (texel % 5 == 0 ? 4 : 1));
  scene::PunctualLight lamp;
  lamp.position = {-0.7f, 0.9f, -0.6f};
  lamp.intensity = glm::vec3(1, 2, 3);
  scene.punctual = {lamp};
  scene.features.sun = scene.features.punctual = scene.features.environment = scene.features.environment_image = true;
  return scene;
}

TEST_P(ReferenceAgreement, WithTheVoxelTracer) {
  const scene::Scene scene = lit_floor(GetParam());
  for (const std::string ward : {"1992", "dur", "bounded"}) {
    const std::string passes =
        trace_passes(24, R"("paths": 32, "bounces": 0, "regularization": 0, "ward": ")" + ward + '"') +
        R"(, "reference": { "type": "reference_path_trace", "in": { "surface": "gather.surface" },
                            "params": { "paths": 64, "bounces": 0, "ward": ")" +
        ward + R"(" } })";
    std::string outputs;
    for (const std::string output : {"radiance", "diffuse", "specular"}) {
      outputs += (outputs.empty() ? "" : ", ") + ("\"v_" + output) + "\": \"trace." + output + "\", \"r_" + output +
                 "\": \"reference." + output + '"';
    }
    GraphRunOptions options;
    options.frames = 10;
    const std::vector<Images> frames =
        run_graph(graph_text(kSize, kSize, kSize, kSize, passes, outputs), scene, options);
    for (const std::string output : {"radiance", "diffuse", "specular"})
      for (uint32_t channel = 0; channel < 3; ++channel) {
        SampleMean voxels, reference;
        for (const Images& images : frames) {
          voxels.add(mean_of(images.at("v_" + output), channel, 0, 0, kSize, kSize));
          reference.add(mean_of(images.at("r_" + output), channel, 0, 0, kSize, kSize));
        }
        // The G-buffer's halves leave a thousandth.
        EXPECT_NEAR(reference.mean(), voxels.mean(),
                    4.5 * std::hypot(voxels.error(), reference.error()) + 2e-3 * voxels.mean())
            << ward << ' ' << output << ' ' << channel;
        EXPECT_LT(reference.error(), 0.02 * reference.mean() + 1e-6) << ward << ' ' << output;
      }
  }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, ReferenceAgreement,
                         testing::Values(Surface{"glossy", 0, 0.5f, 0}, Surface{"rough", 0, 0.9f, 0},
                                         Surface{"brushed", 1, 0.45f, 0.5f}, Surface{"mixed", 0.5f, 0.6f, 0.7f}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace lightloom::test
