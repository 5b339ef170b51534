// White furnace: under light that is the same from everywhere, a convex object shows its directional albedo.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/passes/light_scenes.hpp"
#include "tests/passes/voxel_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

class LightFurnace : public DeviceTest {};

scene::Scene in_furnace(scene::Scene scene) {
  scene.environment.radiance = glm::vec3(1);
  scene.features.environment = true;
  return scene;
}

/// A cube that no axis is aligned with, so that all of its voxels are steps.
scene::Scene tilted_cube(const scene::Material& material) {
  const glm::quat turned = glm::normalize(glm::quat(0.82f, 0.31f, -0.42f, 0.2f));
  scene::Scene scene = make_triangle_scene(cube_triangles(1, glm::mat3_cast(turned)), {material});
  scene.cameras = {look_at({0, 0, 5}, {0, 0, 0}, 0.7f)};
  return scene;
}

TEST_F(LightFurnace, ConvexLambertianObjectShowsItsAlbedo) {
  for (const float base : {1.0f, 0.5f}) {
    const scene::Scene scene = in_furnace(tilted_cube(lambertian(glm::vec3(base))));
    const std::vector<Images> frames = trace_frames(scene, {.params = R"("paths": 4)", .resolution = 40, .frames = 1});
    const image::HostImage& radiance = frames.front().at("radiance");
    int lit = 0;
    for (uint32_t y = 0; y < 32; ++y)
      for (uint32_t x = 0; x < 32; ++x) {
        if (radiance.at(x, y, 0, 3) == 0) continue;
        // Divided by the base colour. No ray from a convex object meets it again, so there is no noise at all.
        ASSERT_NEAR(radiance.at(x, y, 0, 1), 1, 1e-3) << base << " at " << x << " " << y;
        ++lit;
      }
    EXPECT_GT(lit, 200);
  }
}

/// A floor in stripes along z, one of each material, that fill the image seen from above: stripe k takes the columns
/// from k * 32 / materials on.
scene::Scene stripes(const std::vector<scene::Material>& materials, const glm::vec3& eye) {
  std::vector<QuadSpec> quads;
  const float width = 4.0f / static_cast<float>(materials.size());
  for (uint32_t k = 0; k < materials.size(); ++k)
    quads.push_back({{-2 + width * static_cast<float>(k), 0, 2}, {width, 0, 0}, {0, 0, -4}, k});
  return in_furnace(make_quad_scene(quads, materials, orthographic(eye, {0, 0, 0}, 2)));
}

/// Pixels of stripe k of `count`, but for those at its borders.
SampleMean stripe(const std::vector<Images>& frames, uint32_t k, uint32_t count) {
  SampleMean estimate;
  for (const Images& images : frames) add_pixels(estimate, images, 1, k * 32 / count + 1, (k + 1) * 32 / count - 1);
  return estimate;
}

TEST_F(LightFurnace, WhiteMetalAtNormalViewHasTheAlbedoOfItsLobe) {
  const double alphas[] = {0.25, 0.5, 1, 0.0625};
  const auto bounded = [](double a) { return 1 - a * a * (1 - std::exp(-1 / (a * a))); };
  struct Case {
    const char* ward;
    double albedo[4];  ///< by alpha; 0: not compared
  };
  // The bounded form has a closed form, the other two come from quadrature to 12 digits.
  const Case cases[] = {{"bounded", {bounded(0.25), bounded(0.5), bounded(1), bounded(0.0625)}},
                        {"dur", {0, 0.694741897039629, 0.352638286751174, 0}},
                        {"1992", {0, 0.585490376444347, 0.256445212511538, 0}}};
  std::vector<scene::Material> metals(4);
  for (size_t k = 0; k < 4; ++k) metals[k].roughness = static_cast<float>(std::sqrt(alphas[k]));
  const scene::Scene scene = stripes(metals, {0, 3, 0});
  for (const Case& c : cases) {
    const std::string params = R"("paths": 64, "ward": ")" + std::string(c.ward) + "\"";
    const std::vector<Images> frames = trace_frames(scene, {.params = params, .resolution = 16, .frames = 2});
    for (uint32_t k = 0; k < 4; ++k) {
      ASSERT_NEAR(frames.front().at("material").at(k * 8 + 4, 16, 0, 0), alphas[k], 1e-3 * alphas[k]);
      if (c.albedo[k] == 0) continue;
      const SampleMean estimate = stripe(frames, k, 4);
      EXPECT_LT(estimate.error(), 3e-3);
      EXPECT_NEAR(estimate.mean(), c.albedo[k], 3.5 * estimate.error() + 1e-4) << c.ward << " " << alphas[k];
    }
  }
}

TEST_F(LightFurnace, NothingReflectsMoreThanArrives) {
  std::vector<scene::Material> materials;
  for (const float metallic : {0.0f, 1.0f})
    for (const float roughness : {0.05f, 0.4f, 1.0f, 0.7f}) {
      scene::Material material;
      material.metallic = metallic;
      material.roughness = roughness;
      material.anisotropy_strength = 0.7f;
      materials.push_back(material);
    }
  // Seen nearly along the surface too, where lobes tend to gain.
  for (const glm::vec3 eye : {glm::vec3(0, 3, 0), glm::vec3(0, 0.1f, 3)}) {
    const std::vector<Images> frames = trace_frames(stripes(materials, eye), {.params = R"("paths": 64)"});
    for (uint32_t k = 0; k < 8; ++k) {
      const SampleMean estimate = stripe(frames, k, 8);
      ASSERT_GT(estimate.count(), 3) << eye.y;
      // The modulation colour is the reflectance of the whole material under the same light, at most 1.
      EXPECT_LE(estimate.mean(), 1 + 1e-3 + 3 * estimate.error()) << k << " " << eye.y;
      EXPECT_GT(estimate.mean(), 0.3) << k << " " << eye.y;
    }
  }
}

}  // namespace
}  // namespace lightloom::test
