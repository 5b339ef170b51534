#include "framework/scene/origin.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "framework/scene/camera_path.hpp"
#include "tests/scene/gltf_builder.hpp"

namespace lightloom::scene {
namespace {

using test::GltfBuilder;
using test::TemporaryFolder;

const std::vector<glm::dvec3> kFarPlaces = {
    {1e5, 0, 0}, {-1e6, 1e6, 3}, {1e7, -1e7, 1e7}, {123456.789, 0, -98765.4321}};
/// Of a scene of 3 m: floats hold its coordinates to 2e-7 m, and joints add up four of them.
constexpr double kTolerance = 2e-6;

/// A turned node at `place` that carries a still quad, a moving one with a lamp and a camera, and a skinned one.
GltfBuilder moving_world(const glm::dvec3& place) {
  GltfBuilder builder;
  const int quad = builder.quad();
  const int joints = builder.accessor<uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
  const int weights =
      builder.accessor<float>({0.5f, 0.5f, 0, 0, 0.25f, 0.75f, 0, 0, 1, 0, 0, 0, 0.7f, 0.3f, 0, 0}, "VEC4");
  nlohmann::json attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = joints;
  attributes["WEIGHTS_0"] = weights;
  const int skinned = builder.mesh(attributes, builder.json["meshes"][0]["primitives"][0]["indices"]);
  builder.json["extensionsUsed"] = {"KHR_lights_punctual"};
  builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
  builder.append("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}});
  builder.append("skins", {{"joints", {3, 4}}});
  builder.node({{"translation", {place.x, place.y, place.z}},
                {"rotation", {0, 0.5, 0, 0.8660254037844386}},
                {"children", {1, 2, 3, 4, 5}}});
  builder.node({{"mesh", quad}});
  builder.node({{"mesh", quad}, {"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  builder.node({{"translation", {0, 1, 0}}});
  builder.node({{"translation", {1, 0, 1}}});
  builder.node({{"mesh", skinned}, {"skin", 0}});
  builder.animation(2, "translation", {0, 1}, {0, 0, 0, 0.5f, 0.25f, 1});
  // All in one animation: a scene plays the first.
  const int more = builder.animation(4, "translation", {0, 1}, {1, 0, 1, 0, 1, 0});
  nlohmann::json& animations = builder.json["animations"];
  animations[0]["samplers"].push_back(animations[static_cast<size_t>(more)]["samplers"][0]);
  animations[0]["channels"].push_back({{"sampler", 1}, {"target", {{"node", 4}, {"path", "translation"}}}});
  animations.erase(1);
  return builder;
}

double largest_difference(const std::vector<Vertex>& near, const std::vector<Vertex>& far, const glm::dvec3& shift) {
  double largest = near.size() == far.size() ? 0 : 1e9;
  for (size_t i = 0; i < std::min(near.size(), far.size()); ++i) {
    largest = std::max(largest, glm::distance(glm::dvec3(near[i].position) + shift, glm::dvec3(far[i].position)));
    largest = std::max(largest, glm::distance(glm::dvec3(near[i].normal), glm::dvec3(far[i].normal)));
  }
  return largest;
}

TEST(SceneOrigin, WhatMovesFarOffMovesAsItDoesAtHome) {
  const Scene near = moving_world(glm::dvec3(0)).load();
  ASSERT_EQ(near.origin, glm::dvec3(0));
  ASSERT_EQ(near.vertices.size(), 12u);
  ASSERT_EQ(near.static_vertex_count, 4u);
  for (const glm::dvec3& place : kFarPlaces) {
    const Scene far = moving_world(place).load();
    const glm::dvec3 shift = place - far.origin;  // of the far scene's coordinates against the near one's
    EXPECT_LT(glm::length(shift), 16);
    EXPECT_LT(largest_difference(near.vertices, far.vertices, shift), kTolerance);
    for (const double time : {0.0, 0.25, 0.8}) {
      const Pose here = pose(near, time), there = pose(far, time);
      EXPECT_LT(largest_difference(here.dynamic_vertices, there.dynamic_vertices, shift), kTolerance) << time;
      EXPECT_LT(glm::distance(glm::dvec3(here.punctual[0].position) + shift, glm::dvec3(there.punctual[0].position)),
                kTolerance);
      const glm::mat4 &eye = here.cameras[0].world_from_camera, &far_eye = there.cameras[0].world_from_camera;
      EXPECT_LT(glm::distance(glm::dvec3(eye[3]) + shift, glm::dvec3(far_eye[3])), kTolerance);
      EXPECT_LT(glm::distance(eye[2], far_eye[2]), 1e-6f);
    }
    EXPECT_LT(glm::distance(glm::dvec3(near.bounds.min) + shift, glm::dvec3(far.bounds.min)), kTolerance);
    EXPECT_LT(glm::distance(glm::dvec3(near.bounds.max) + shift, glm::dvec3(far.bounds.max)), kTolerance);
  }
}

TEST(SceneOrigin, CamerasAndInstancesOfSceneFilesAndPathsFollow) {
  const TemporaryFolder folder;
  GltfBuilder quad;
  quad.node({{"mesh", quad.quad()}});
  GltfBuilder far_quad;
  far_quad.node({{"mesh", far_quad.quad()}, {"translation", {1e7, 0, 0}}});
  folder.write("quad.gltf", quad.gltf());
  folder.write("far.gltf", far_quad.gltf());
  const Scene scene = load_scene(folder.write("s.scene.json", R"({
    "lightloom_scene": 1, "gltf": "far.gltf",
    "instances": [{"gltf": "quad.gltf", "translation": [10000001.375, 0.5, 0], "rotation_y_degrees": 90}],
    "cameras": {"c": {"eye": [10000000.25, 0.5, 4.125], "target": [10000000.25, 0.5, 0]}}})"));
  EXPECT_EQ(glm::fract(scene.origin), glm::dvec3(0));
  EXPECT_LT(std::abs(scene.origin.x - 1e7), 4);
  const auto world = [&](const glm::vec3& point) { return glm::dvec3(point) + scene.origin; };
  EXPECT_EQ(world(scene.vertices[0].position), glm::dvec3(1e7, 0, 0));
  EXPECT_LT(glm::distance(world(scene.vertices[4].position), glm::dvec3(10000001.375, 0.5, 0)), 1e-6);
  EXPECT_EQ(world(glm::vec3(scene.cameras[0].world_from_camera[3])), glm::dvec3(10000000.25, 0.5, 4.125));

  const CameraPath path = read_camera_path(folder.write("path.json", R"({
    "lightloom_camera_path": 1, "interpolation": "linear", "keyframes": [
      {"time": 0, "position": [10000000, 0, 2], "target": [10000000, 0, 0]},
      {"time": 1, "position": [10000000.5, 0, 2], "target": [10000000.5, 0, 0]}]})"));
  const Camera camera = camera_on_path(path, 0.5, scene.cameras[0], scene.origin);
  EXPECT_EQ(world(glm::vec3(camera.world_from_camera[3])), glm::dvec3(10000000.25, 0, 2));
  EXPECT_EQ(glm::vec3(camera.world_from_camera[2]), glm::vec3(0, 0, 1));
}

TEST(SceneOrigin, ScenesNearTheWorldsOriginKeepTheirCoordinates) {
  for (const float x : {0.0f, 1.0f, -3.0f, 6.9f}) {
    GltfBuilder builder;
    builder.node({{"mesh", builder.quad()}, {"translation", {x, 0, 0}}});
    const Scene scene = builder.load();
    EXPECT_EQ(scene.origin, glm::dvec3(0)) << x;
    EXPECT_EQ(scene.vertices[0].position.x, x);
  }
  GltfBuilder builder;
  builder.node({{"mesh", builder.quad()}, {"translation", {1000, 0, 0}}});
  builder.node({{"mesh", builder.quad()}, {"translation", {-1000, 0, 0}}});
  EXPECT_EQ(builder.load().origin, glm::dvec3(0)) << "large, not far off";
}

TEST(SceneOrigin, ACameraThatFloatsCannotTellFromItsTargetStillLooksAtIt) {
  const TemporaryFolder folder;
  GltfBuilder quad;
  quad.node({{"mesh", quad.quad()}});
  folder.write("quad.gltf", quad.gltf());
  const Scene scene = load_scene(folder.write("s.scene.json", R"({
    "lightloom_scene": 1, "gltf": "quad.gltf", "cameras": {"c": {"eye": [1e9, 0, 1], "target": [1000000001, 0, 1]}}})"));
  EXPECT_LT(glm::distance(glm::vec3(scene.cameras[0].world_from_camera[2]), glm::vec3(-1, 0, 0)), 1e-6f);
}

TEST(SceneOrigin, AMisplacedTriangleIsSaid) {
  const auto warns = [](const Scene& scene) { return !far_outlier_warning(scene).empty(); };
  GltfBuilder builder;
  for (int i = 0; i < 4; ++i) builder.node({{"mesh", builder.quad()}, {"translation", {0, 0, i}}});
  EXPECT_FALSE(warns(builder.load()));
  const int one = builder.mesh({{"POSITION", builder.accessor<float>({200, 0, 0, 201, 0, 0, 200, 1, 0}, "VEC3")}});
  builder.node({{"mesh", one}});
  const Scene scene = builder.load();
  EXPECT_TRUE(warns(scene));
  EXPECT_THAT(scene.warnings, ::testing::Contains(::testing::HasSubstr("all but 1 of the 9 triangles")));
}

}  // namespace
}  // namespace lightloom::scene
