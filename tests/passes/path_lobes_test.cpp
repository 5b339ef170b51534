#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/passes/light_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

constexpr uint32_t kSize = 32;

const std::string kAll =
    R"("radiance": "trace.radiance", "diffuse": "trace.diffuse", "specular": "trace.specular",
       "position": "gather.surface.position", "normal": "gather.surface.normal", "albedo": "gather.surface.albedo",
       "material": "gather.surface.material")";

class PathLobes : public DeviceTest {
 protected:
  static Images trace(const scene::Scene& scene, const std::string& params, const std::string& outputs = kAll) {
    return run_graph(graph_text(kSize, kSize, kSize, kSize, trace_passes(32, params), outputs), scene, {}).front();
  }
};

constexpr glm::dvec3 kEye(-1.5, 1.2, 1.5);

/// A floor with a block on it under a sun and a sky.
scene::Scene lit_scene(const scene::Material& material) {
  const std::vector<QuadSpec> quads = {{{-2, 0, 2}, {4, 0, 0}, {0, 0, -4}}, {{0, 0, 0.5f}, {0.8f, 0, 0}, {0, 1, 0}}};
  scene::Scene scene = make_quad_scene(quads, {material}, look_at(glm::vec3(kEye), {0.2f, 0.2f, 0}, 0.8f));
  scene.environment.radiance = glm::vec3(1, 2, 3);
  scene.sun = scene::Sun{glm::normalize(glm::vec3(0.4f, -1, 0.1f)), glm::vec3(4), 0.1f};
  scene.features.environment = scene.features.sun = true;
  return scene;
}

scene::Material glossy() {
  scene::Material material;
  material.base_color = glm::vec4(0.7f, 0.3f, 0.1f, 1);
  material.metallic = 0.25f;
  material.roughness = 0.5f;
  return material;
}

struct Colors {
  double diffuse, specular;  ///< what each lobe reflects to the viewer, by Schlick's formula in double precision
};

Colors colors_at(const Images& images, uint32_t x, uint32_t y, uint32_t channel) {
  const auto vector = [&](const char* name) {
    const image::HostImage& image = images.at(name);
    return glm::dvec3(image.at(x, y, 0, 0), image.at(x, y, 0, 1), image.at(x, y, 0, 2));
  };
  const double cosine = glm::dot(glm::normalize(kEye - vector("position")), glm::normalize(vector("normal")));
  const double base = images.at("albedo").at(x, y, 0, channel), metallic = images.at("albedo").at(x, y, 0, 3);
  const double f0 = images.at("material").at(x, y, 0, 2), f90 = images.at("material").at(x, y, 0, 3);
  const double grazing = std::pow(1 - cosine, 5), dielectric = f0 + (f90 - f0) * grazing;
  return {base * (1 - metallic) * (1 - dielectric),
          (1 - metallic) * dielectric + metallic * (base + (1 - base) * grazing)};
}

TEST_F(PathLobes, LobesTimesTheirColoursAreTheWhole) {
  const Images images = trace(lit_scene(glossy()), R"("paths": 4)");
  int lit = 0;
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x) {
      if (images.at("radiance").at(x, y, 0, 3) == 0) continue;
      ASSERT_EQ(images.at("diffuse").at(x, y, 0, 3), 1);
      ASSERT_EQ(images.at("specular").at(x, y, 0, 3), 1);
      for (uint32_t c = 0; c < 3; ++c) {
        const Colors colors = colors_at(images, x, y, c);
        const double whole = images.at("radiance").at(x, y, 0, c) * (colors.diffuse + colors.specular);
        const double diffuse = images.at("diffuse").at(x, y, 0, c) * colors.diffuse;
        const double specular = images.at("specular").at(x, y, 0, c) * colors.specular;
        ASSERT_NEAR(diffuse + specular, whole, 1e-5 * whole) << x << " " << y;
        lit += diffuse > 0 && specular > 0 ? 1 : 0;
      }
    }
  EXPECT_GT(lit, 1000);
}

TEST_F(PathLobes, ALobeThatIsNotThereIsBlack) {
  scene::Material metal = glossy();
  metal.metallic = 1;
  const Images shiny = trace(lit_scene(metal), R"("paths": 1)");
  const Images matt = trace(lit_scene(lambertian(glm::vec3(0.6f))), R"("paths": 1)");
  double largest = 0, specular = 0, diffuse = 0;
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x) {
      largest = std::max({largest, shiny.at("diffuse").at(x, y, 0, 0), matt.at("specular").at(x, y, 0, 0)});
      specular += shiny.at("specular").at(x, y, 0, 0);
      diffuse += matt.at("diffuse").at(x, y, 0, 0);
    }
  EXPECT_EQ(largest, 0);
  EXPECT_GT(specular, 100);
  EXPECT_GT(diffuse, 100);
}

TEST_F(PathLobes, BaseUnderAnEvenSkyReflectsThatSky) {
  // The base's directional albedo is its modulation colour (Shirley et al. 1997), so what is left is the sky.
  scene::Scene scene = make_quad_scene({{{-2, 0, 2}, {4, 0, 0}, {0, 0, -4}}}, {glossy()},
                                       look_at({0, 3, 0.01f}, {0, 0, 0}, 0.9f, {0, 0, -1}));
  scene.environment.radiance = glm::vec3(3);
  scene.features.environment = true;
  const Images images = trace(scene, R"("paths": 64)");
  EXPECT_NEAR(mean_of(images.at("diffuse"), 0, 0, 0, kSize, kSize), 3, 0.03);
  EXPECT_NEAR(mean_of(images.at("diffuse"), 2, 0, 0, kSize, kSize), 3, 0.03);
  EXPECT_LE(mean_of(images.at("specular"), 0, 0, 0, kSize, kSize), 3.03);
}

TEST_F(PathLobes, WhatNobodyWantsChangesNothing) {
  const scene::Scene scene = lit_scene(glossy());
  const Images all = trace(scene, R"("paths": 1)");
  for (const std::string name : {"radiance", "diffuse", "specular"}) {
    const Images alone = trace(scene, R"("paths": 1)", "\"" + name + "\": \"trace." + name + "\"");
    EXPECT_EQ(alone.at(name).texels, all.at(name).texels) << name;
  }
}

}  // namespace
}  // namespace lightloom::test
