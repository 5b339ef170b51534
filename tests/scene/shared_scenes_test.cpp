#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/constants.hpp>
#include <random>
#include <set>

#include "framework/scene/describe.hpp"
#include "tests/scene/gltf_builder.hpp"

namespace lightloom::scene {
namespace {

using test::shared_scenes;

struct Expected {
  const char* file;
  size_t triangles;  ///< as the file counts them
  size_t dropped;    ///< degenerate ones among them, and those of glass
  std::set<std::string> features;
};

const std::vector<Expected>& expected_scenes() {
  static const std::vector<Expected> scenes = {
      {"sponza.scene.json", 262267, 1, {"sun", "environment", "textured", "alpha", "normal_mapped", "specular"}},
      {"sponza_glossy.scene.json", 262267, 1, {"sun", "environment", "textured", "alpha", "normal_mapped", "specular"}},
      {"sponza_dynamic.scene.json",
       262267 + 2 * 576 + 4672 + 254,
       1,
       {"dynamic", "sun", "environment", "textured", "alpha", "normal_mapped", "specular"}},
      {"cornell_box_original_emissive/scene.gltf", 32, 0, {"emissive", "specular"}},
      {"cornell_box_original_emissive/scene_lambertian.gltf", 32, 0, {"emissive"}},
      {"cornell_box_bevy/CornellBox.glb", 36, 0, {"emissive", "specular"}},
      {"anisotropy_barn_lamp/AnisotropyBarnLamp.gltf",
       10203,
       1504,
       {"emissive", "textured", "normal_mapped", "specular", "anisotropic", "metallic"}},
      {"kajiya/roughness-scale/scene.gltf", 51200, 0, {"textured", "specular"}},
      {"kajiya/floor/scene.gltf", 12, 0, {"textured", "specular", "metallic"}},
      {"kajiya/emissive/triangle.glb", 1, 0, {"emissive", "specular"}},
      {"many_cubes/many-cubes.gltf", 6012, 0, {"specular", "metallic"}},
      {"khronos/BoxAnimated/glTF/BoxAnimated.gltf", 254, 0, {"dynamic", "specular"}},
      {"khronos/BoxAnimated/glTF-Embedded/BoxAnimated.gltf", 254, 0, {"dynamic", "specular"}},
      {"khronos/BoxAnimated/glTF-Binary/BoxAnimated.glb", 254, 0, {"dynamic", "specular"}},
      {"khronos/Fox/glTF/Fox.gltf", 576, 0, {"dynamic", "textured", "specular"}},
      {"khronos/CesiumMan/glTF-Binary/CesiumMan.glb", 4672, 0, {"dynamic", "textured", "specular"}},
      {"khronos/AnimatedMorphCube/glTF/AnimatedMorphCube.gltf", 12, 0, {"dynamic", "specular"}},
      {"khronos/AnimatedTriangle/glTF/AnimatedTriangle.gltf", 1, 0, {"dynamic", "specular", "metallic"}},
      {"khronos/SimpleSkin/SimpleSkin.gltf", 8, 0, {"dynamic", "specular", "metallic"}},
      {"khronos/TextureSettingsTest/glTF/TextureSettingsTest.gltf", 72, 0, {"textured", "specular"}},
      {"khronos/BoxVertexColors/glTF/BoxVertexColors.gltf", 12, 0, {"specular", "metallic"}},
  };
  return scenes;
}

/// glTF files without camera or light, which get a sky and a sun; the Cornell boxes bring their own.
bool is_model(const std::string& file) {
  return file.find("scene.json") == std::string::npos && file.find("cornell_box_original") == std::string::npos;
}

TEST(SharedScenes, HaveTheirTrianglesAndFeatures) {
  LIGHTLOOM_NEED_SHARED(folder);
  for (const Expected& expected : expected_scenes()) {
    SCOPED_TRACE(expected.file);
    const Scene scene = load_scene(folder / expected.file);
    EXPECT_EQ(scene.triangles.size() + expected.dropped, expected.triangles);
    std::set<std::string> present;
    for (const auto& [name, value] : scene.features.named()) {
      if (value) present.insert(name);
    }
    std::set<std::string> features = expected.features;
    if (is_model(expected.file)) features.insert({"sun", "environment"});
    EXPECT_EQ(present, features);
    EXPECT_FALSE(scene.cameras.empty());
    EXPECT_NE(describe(scene).find("triangles"), std::string::npos);
  }
}

void expect_sound(const Scene& scene) {
  const auto vertex_count = static_cast<uint32_t>(scene.vertices.size());
  for (size_t t = 0; t < scene.triangles.size(); ++t) {
    const Triangle& triangle = scene.triangles[t];
    ASSERT_LT(std::max({triangle.a, triangle.b, triangle.c}), vertex_count);
    const bool is_static = t < scene.static_triangle_count;
    ASSERT_EQ(triangle.a < scene.static_vertex_count, is_static);
    ASSERT_EQ(triangle.b < scene.static_vertex_count, is_static);
    ASSERT_EQ(triangle.c < scene.static_vertex_count, is_static);
    ASSERT_LT(triangle.material, scene.materials.size());
    ASSERT_LT(triangle.object, scene.objects.size());
  }
  for (const Vertex& vertex : scene.vertices) {
    const glm::vec3 tangent(vertex.tangent);
    ASSERT_NEAR(glm::length(vertex.normal), 1, 1e-5);
    ASSERT_NEAR(glm::length(tangent), 1, 1e-5);
    ASSERT_NEAR(glm::dot(vertex.normal, tangent), 0, 1e-5);
    ASSERT_EQ(std::abs(vertex.tangent.w), 1.0f);
  }
}

TEST(SharedScenes, EveryFileHasValidIndicesAndOrthonormalFrames) {
  LIGHTLOOM_NEED_SHARED(folder);
  for (const Expected& expected : expected_scenes()) {
    SCOPED_TRACE(expected.file);
    expect_sound(load_scene(folder / expected.file));
  }
}

TEST(SharedScenes, BoundsContainEveryPoseAtRandomTimes) {
  LIGHTLOOM_NEED_SHARED(folder);
  std::mt19937 random(7);
  for (const char* file : {"khronos/Fox/glTF/Fox.gltf", "khronos/CesiumMan/glTF-Binary/CesiumMan.glb",
                           "khronos/SimpleSkin/SimpleSkin.gltf", "khronos/BoxAnimated/glTF/BoxAnimated.gltf",
                           "khronos/AnimatedMorphCube/glTF/AnimatedMorphCube.gltf", "sponza_dynamic.scene.json"}) {
    SCOPED_TRACE(file);
    const Scene scene = load_scene(folder / file);
    std::uniform_real_distribution<double> times(-3 * scene.duration, 5 * scene.duration);
    for (int i = 0; i < 40; ++i) {
      for (const Vertex& vertex : pose(scene, times(random)).dynamic_vertices) {
        ASSERT_TRUE(glm::all(glm::greaterThanEqual(vertex.position, scene.bounds.min)) &&
                    glm::all(glm::lessThanEqual(vertex.position, scene.bounds.max)));
      }
    }
  }
}

TEST(SharedScenes, PoseAtTimeZeroEqualsTheLoadedVertices) {
  LIGHTLOOM_NEED_SHARED(folder);
  for (const char* file : {"khronos/Fox/glTF/Fox.gltf", "sponza_dynamic.scene.json"}) {
    const Scene scene = load_scene(folder / file);
    const Pose posed = pose(scene, 0);
    ASSERT_EQ(posed.dynamic_vertices.size(), scene.vertices.size() - scene.static_vertex_count);
    EXPECT_EQ(std::memcmp(posed.dynamic_vertices.data(), scene.vertices.data() + scene.static_vertex_count,
                          posed.dynamic_vertices.size() * sizeof(Vertex)),
              0);
  }
}

// BoxAnimated lifts its inner box to y = 2.52 and turns it by half a turn; the outer box stands still.
TEST(SharedScenes, BoxAnimatedIsWhereItsKeysSay) {
  LIGHTLOOM_NEED_SHARED(folder);
  const Scene scene = load_scene(folder / "khronos/BoxAnimated/glTF/BoxAnimated.gltf");
  EXPECT_EQ(scene.static_triangle_count, 192u);
  EXPECT_NEAR(scene.duration, 3.708329916, 1e-6);
  const auto mean_height = [&](double time) {
    double sum = 0;
    const Pose posed = pose(scene, time);
    for (const Vertex& vertex : posed.dynamic_vertices) sum += static_cast<double>(vertex.position.y);
    return sum / static_cast<double>(posed.dynamic_vertices.size());
  };
  const double rest = mean_height(0);
  EXPECT_NEAR(mean_height(1.25) - rest, 2.519999981, 1e-4);
  EXPECT_NEAR(mean_height(2.5) - rest, 2.519999981, 1e-4);
  EXPECT_NEAR(mean_height(3.7083) - rest, 0, 1e-3);
  EXPECT_NEAR(mean_height(0.625) - rest, 1.26, 1e-4);
  EXPECT_NEAR(mean_height(0.625 + 2 * scene.duration) - rest, 1.26, 1e-4);
}

// SimpleSkin turns its upper joint, at (0, 1, 0), by a quarter turn to one side at t = 1.5 s.
TEST(SharedScenes, SimpleSkinBendsAboutItsJoint) {
  LIGHTLOOM_NEED_SHARED(folder);
  const Scene scene = load_scene(folder / "khronos/SimpleSkin/SimpleSkin.gltf");
  const Scene& rest = scene;
  const Pose posed = pose(scene, 1.5);
  size_t tips = 0, feet = 0;
  for (size_t i = 0; i < posed.dynamic_vertices.size(); ++i) {
    const glm::vec3 from = rest.vertices[i].position, to = posed.dynamic_vertices[i].position;
    if (std::abs(from.y - 2) < 1e-4f) {
      ++tips;
      const glm::vec3 arm = to - glm::vec3(0, 1, 0);
      const glm::vec3 before = from - glm::vec3(0, 1, 0);
      EXPECT_NEAR(glm::length(arm), glm::length(before), 1e-4);
      EXPECT_NEAR(glm::dot(arm, before), 0, 1e-3) << "a quarter turn";
    }
    if (std::abs(from.y) < 1e-4f) {
      ++feet;
      EXPECT_NEAR(glm::distance(from, to), 0, 1e-5);
    }
  }
  EXPECT_GT(tips, 0u);
  EXPECT_GT(feet, 0u);
}

TEST(SharedScenes, BarnLampKeepsItsAnisotropy) {
  LIGHTLOOM_NEED_SHARED(folder);
  const Scene scene = load_scene(folder / "anisotropy_barn_lamp/AnisotropyBarnLamp.gltf");
  size_t anisotropic = 0, emissive = 0;
  for (const Material& material : scene.materials) {
    if (material.anisotropy_strength > 0) {
      ++anisotropic;
      EXPECT_GE(material.anisotropy_texture.image, 0);
    }
    if (material.emission != glm::vec3(0)) {
      ++emissive;
      EXPECT_EQ(material.emission, glm::vec3(25, 12.5f, 6.25f));
    }
  }
  EXPECT_GE(anisotropic, 1u);
  EXPECT_EQ(emissive, 1u);
}

TEST(SharedScenes, AllContainersOfOneModelGiveTheSameScene) {
  LIGHTLOOM_NEED_SHARED(folder);
  const Scene a = load_scene(folder / "khronos/BoxAnimated/glTF/BoxAnimated.gltf");
  for (const char* other :
       {"khronos/BoxAnimated/glTF-Embedded/BoxAnimated.gltf", "khronos/BoxAnimated/glTF-Binary/BoxAnimated.glb"}) {
    const Scene b = load_scene(folder / other);
    ASSERT_EQ(a.vertices.size(), b.vertices.size());
    for (size_t i = 0; i < a.vertices.size(); ++i)
      EXPECT_LT(glm::distance(a.vertices[i].position, b.vertices[i].position), 1e-5f);
  }
}

TEST(SharedScenes, LoadingTwiceGivesTheSameBytes) {
  LIGHTLOOM_NEED_SHARED(folder);
  const Scene a = load_scene(folder / "sponza_dynamic.scene.json"),
              b = load_scene(folder / "sponza_dynamic.scene.json");
  ASSERT_EQ(a.vertices.size(), b.vertices.size());
  EXPECT_EQ(std::memcmp(a.vertices.data(), b.vertices.data(), a.vertices.size() * sizeof(Vertex)), 0);
  EXPECT_EQ(std::memcmp(a.triangles.data(), b.triangles.data(), a.triangles.size() * sizeof(Triangle)), 0);
  for (size_t i = 0; i < a.images.size(); ++i) EXPECT_EQ(a.images[i].rgba, b.images[i].rgba);
}

}  // namespace
}  // namespace lightloom::scene
