#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/gtc/constants.hpp>

#include "framework/base/error.hpp"
#include "tests/scene/gltf_builder.hpp"

namespace lightloom::scene {
namespace {

using test::GltfBuilder;
using test::TemporaryFolder;
using ::testing::HasSubstr;

class SceneFileTest : public ::testing::Test {
 protected:
  SceneFileTest() {
    GltfBuilder still;
    still.node({{"mesh", still.quad()}});
    folder.write("still.gltf", still.gltf());
    GltfBuilder moving;
    const int node = moving.node({{"mesh", moving.quad()}});
    moving.animation(node, "translation", {0, 2}, {0, 0, 0, 2, 0, 0});
    moving.animation(node, "translation", {0, 1}, {0, 0, 0, 0, 0, 1});
    moving.json["animations"][0]["name"] = "Slide";
    moving.json["animations"][1]["name"] = "Push";
    folder.write("moving box.gltf", moving.gltf());
  }

  Scene load(const std::string& json) const { return load_scene(folder.write("s.scene.json", json)); }

  std::string error_of(const std::string& json) const {
    try {
      (void)load(json);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::invalid_input);
      return error.what() + std::string(" | ") + error.hint();
    }
    return "no error";
  }

  TemporaryFolder folder;
};

TEST_F(SceneFileTest, ReadsEverything) {
  const Scene scene = load(R"({
    "lightloom_scene": 1, "gltf": "still.gltf",
    "instances": [{"gltf": "moving box.gltf", "translation": [1, 2, 3], "rotation_y_degrees": 90, "scale": 2, "animation": "Push", "time_offset_seconds": 0.25}],
    "cameras": {"b": {"eye": [0, 0, 5], "target": [0, 0, 0]}, "a": {"eye": [0, 5, 0], "target": [0, 0, 0], "up": [1, 0, 0], "vertical_fov_degrees": 90}},
    "sun": {"direction": [0, -2, 0], "irradiance": [1, 2, 3], "angular_radius_degrees": 0.5},
    "environment": {"radiance": [0.5, 0.25, 0.125]}})");
  ASSERT_EQ(scene.cameras.size(), 2u);
  EXPECT_EQ(scene.cameras[0].name, "b") << "in the order of the file";
  EXPECT_EQ(scene.cameras[1].vertical_fov, glm::half_pi<float>());
  EXPECT_NEAR(scene.cameras[1].world_from_camera[2].y, 1, 1e-6) << "looks along -z";
  EXPECT_NEAR(scene.cameras[1].world_from_camera[1].x, 1, 1e-6) << "up";
  EXPECT_EQ(scene.sun->direction, glm::vec3(0, -1, 0));
  EXPECT_EQ(scene.environment.radiance, glm::vec3(0.5f, 0.25f, 0.125f));
  EXPECT_TRUE(scene.features.sun && scene.features.environment && scene.features.dynamic);
  EXPECT_FALSE(scene.features.environment_image);
  EXPECT_EQ(scene.duration, 1);
  // The corner at the origin: pushed by 0.25 along z, doubled, turned to +x, moved.
  EXPECT_NEAR(glm::distance(scene.vertices[scene.static_vertex_count].position, {1.5f, 2, 3}), 0, 1e-5);
  // The corner (1, 0, 0) goes to -z.
  EXPECT_NEAR(glm::distance(scene.vertices[scene.static_vertex_count + 1].position, {1.5f, 2, 1}), 0, 1e-5);
}

TEST_F(SceneFileTest, SharesAFileBetweenInstances) {
  const Scene scene = load(
      R"({"lightloom_scene": 1, "gltf": "still.gltf", "instances": [{"gltf": "still.gltf"}, {"gltf": "./still.gltf", "translation": [0, 0, 1]}]})");
  EXPECT_EQ(scene.triangles.size(), 6u);
  EXPECT_EQ(scene.objects.size(), 3u);
  EXPECT_EQ(scene.materials.size(), 1u);
  EXPECT_EQ(scene.cameras.at(0).name, "default");
}

TEST_F(SceneFileTest, ErrorsNameThePlace) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"{\n  \"lightloom_scene\": 1,\n  \"gltf\": \"still.gltf\",\n  \"camera\": {}\n}",
       "s.scene.json:4:3: camera is not a known member | did you mean 'cameras'?"},
      {R"({"gltf": "still.gltf"})", "lightloom_scene is missing"},
      {R"({"lightloom_scene": 2, "gltf": "still.gltf"})", ":1:21: lightloom_scene is 2, expected 1"},
      {R"({"lightloom_scene": 1})", "gltf is missing"},
      {R"({"lightloom_scene": 1, "gltf": "none.gltf"})", "none.gltf does not exist"},
      {R"({"lightloom_scene": 1, "gltf": 3})", "gltf is an integer, expected a string"},
      {R"({"lightloom_scene": 1, "gltf": "still.gltf", "sun": {"direction": [0, 0, 0], "irradiance": [1, 1, 1]}})",
       "sun.direction is zero"},
      {R"({"lightloom_scene": 1, "gltf": "still.gltf", "sun": {"direction": [0, 1, 0], "irradiance": [1, -1, 1]}})",
       "sun.irradiance[1] is -1, expected a value from 0"},
      {R"({"lightloom_scene": 1, "gltf": "still.gltf", "cameras": {"x": {"eye": [0, 0, 0], "target": [0, 0, 0]}}})",
       "cameras.x has the same eye and target"},
      {R"({"lightloom_scene": 1, "gltf": "still.gltf", "cameras": {"x": {"eye": [0, 0, 0], "target": [0, 2, 0]}}})",
       "cameras.x has an up that is zero or along the view"},
      {R"({"lightloom_scene": 1, "gltf": "still.gltf", "cameras": {"x": {"eye": [0, 0], "target": [0, 2, 0]}}})",
       "cameras.x.eye is not an array of 3 numbers"},
      {R"({"lightloom_scene": 1, "gltf": "still.gltf", "environment": {}})", "neither radiance nor image"},
      {R"({"lightloom_scene": 1, "gltf": "still.gltf", "environment": {"image": "sky.hdr"}})",
       "sky.hdr does not exist"},
      {R"({"lightloom_scene": 1, "gltf": "still.gltf", "instances": [{"gltf": "moving box.gltf", "animation": "Psh"}]})",
       "did you mean 'Push'?"},
      {R"({"lightloom_scene": 1, "gltf": "still.gltf", "instances": [{"gltf": "moving box.gltf", "animation": 2}]})",
       "has 2 animations"},
      {R"({"lightloom_scene": 1, "gltf": "still.gltf", "instances": [{"gltf": "still.gltf", "scale": 0}]})",
       "instances[0].scale is 0"},
      {R"({"lightloom_scene": 1, "gltf": )", ":1:32: "},
  };
  for (const auto& [json, expected] : cases) {
    SCOPED_TRACE(json);
    EXPECT_THAT(error_of(json), HasSubstr(expected));
  }
}

TEST_F(SceneFileTest, OtherNamesAndMissingFilesAreErrors) {
  EXPECT_THROW((void)load_scene(folder.path() / "absent.gltf"), Error);
  EXPECT_THROW((void)load_scene(folder.path() / "absent.scene.json"), Error);
  EXPECT_THROW((void)load_scene(folder.write("scene.obj", "o x")), Error);
  EXPECT_THROW((void)load_scene(folder.path()), Error);
  std::filesystem::create_directory(folder.path() / "folder.gltf");
  EXPECT_THROW((void)load_scene(folder.path() / "folder.gltf"), Error);
}

TEST_F(SceneFileTest, EnvironmentImageIsLoaded) {
  LIGHTLOOM_NEED_SHARED(shared);
  const Scene scene = load(R"({"lightloom_scene": 1, "gltf": "still.gltf", "environment": {"image": ")" +
                           (shared / "env/dresden_square_1k.hdr").string() + R"(", "scale": 2}})");
  EXPECT_TRUE(scene.features.environment_image);
  EXPECT_EQ(scene.environment.radiance, glm::vec3(2));
  EXPECT_EQ(scene.environment.width, 2 * scene.environment.height);
  EXPECT_EQ(scene.environment.rgb.size(), size_t{3} * scene.environment.width * scene.environment.height);
}

}  // namespace
}  // namespace lightloom::scene
