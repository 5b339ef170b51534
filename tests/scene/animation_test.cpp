#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <random>

#include "framework/scene/source.hpp"
#include "tests/scene/gltf_builder.hpp"

namespace lightloom::scene {
namespace {

using test::GltfBuilder;

constexpr float kHalf = 0.70710678f;

glm::vec3 mean_position(const std::vector<Vertex>& vertices) {
  glm::vec3 sum(0);
  for (const Vertex& vertex : vertices) sum += vertex.position;
  return sum / static_cast<float>(vertices.size());
}

TEST(Animation, LinearTranslationRepeats) {
  GltfBuilder builder;
  const int node = builder.node({{"mesh", builder.quad()}});
  builder.animation(node, "translation", {0, 1, 4}, {0, 0, 0, 2, 0, 0, 2, 0, 6});
  const Scene scene = builder.load();
  EXPECT_TRUE(scene.features.dynamic);
  EXPECT_EQ(scene.static_triangle_count, 0u);
  EXPECT_EQ(scene.duration, 4);
  const auto offset = [&](double time) {
    return mean_position(pose(scene, time).dynamic_vertices) - glm::vec3(0.5f, 0.5f, 0);
  };
  EXPECT_NEAR(glm::distance(offset(0.25), {0.5f, 0, 0}), 0, 1e-5);
  EXPECT_NEAR(glm::distance(offset(1), {2, 0, 0}), 0, 1e-5);
  EXPECT_NEAR(glm::distance(offset(2.5), {2, 0, 3}), 0, 1e-5);
  EXPECT_NEAR(glm::distance(offset(8.25), {0.5f, 0, 0}), 0, 1e-5);
  EXPECT_NEAR(glm::distance(offset(-3.75), {0.5f, 0, 0}), 0, 1e-5);
}

TEST(Animation, StepHoldsEachKey) {
  GltfBuilder builder;
  const int node = builder.node({{"mesh", builder.quad()}});
  builder.animation(node, "translation", {0, 1, 2}, {0, 0, 0, 5, 0, 0, 7, 0, 0}, "STEP");
  const Scene scene = builder.load();
  const auto x = [&](double time) { return mean_position(pose(scene, time).dynamic_vertices).x - 0.5f; };
  EXPECT_NEAR(x(0.999), 0, 1e-5);
  EXPECT_NEAR(x(1), 5, 1e-5);
  EXPECT_NEAR(x(1.999), 5, 1e-5);
}

// A cubic spline whose tangents are those of a cubic polynomial is that polynomial.
TEST(Animation, CubicSplineReproducesACubic) {
  const auto f = [](double t) { return 2 * t * t * t - 3 * t * t + t - 1; };
  const auto slope = [](double t) { return 6 * t * t - 6 * t + 1; };
  Track track;
  track.interpolation = Interpolation::cubic;
  track.width = 3;
  for (const double time : {0.0, 0.7, 2.0}) {
    track.times.push_back(static_cast<float>(time));
    for (const double value : {slope(time), f(time), slope(time)})
      track.values.insert(track.values.end(), 3, static_cast<float>(value));
  }
  for (double time = 0; time <= 2; time += 0.05) EXPECT_NEAR(sample_track(track, time)[1], f(time), 2e-5) << time;
}

// Slerp turns at constant speed about a fixed axis; the oracle is the quaternion of that turn.
TEST(Animation, RotationTurnsAtConstantSpeed) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 50; ++trial) {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(uniform(random), uniform(random), uniform(random)));
    const double angle = 3 * std::abs(uniform(random)) + 0.05;
    Track track;
    track.path = TrackPath::rotation;
    track.width = 4;
    track.times = {1, 3};
    const double sign = uniform(random) < 0 ? -1 : 1;  // -q is the same rotation, so the shorter way must be taken
    track.values = {0, 0, 0, 1};
    for (const double part : {axis.x * std::sin(angle / 2), axis.y * std::sin(angle / 2), axis.z * std::sin(angle / 2),
                              std::cos(angle / 2)}) {
      track.values.push_back(static_cast<float>(part * sign));
    }
    for (const double amount : {0.0, 0.125, 0.5, 0.9, 1.0}) {
      const std::vector<float> got = sample_track(track, 1 + 2 * amount);
      const double half = angle * amount / 2;
      const double dot = axis.x * std::sin(half) * got[0] + axis.y * std::sin(half) * got[1] +
                         axis.z * std::sin(half) * got[2] + std::cos(half) * got[3];
      EXPECT_NEAR(std::abs(dot), 1, 1e-6);
    }
  }
}

TEST(Animation, ConstantTracksAreBaked) {
  GltfBuilder builder;
  const int node = builder.node({{"mesh", builder.quad()}});
  builder.animation(node, "translation", {0, 1}, {0, 3, 0, 0, 3, 0});
  const Scene scene = builder.load();
  EXPECT_FALSE(scene.features.dynamic);
  EXPECT_EQ(scene.duration, 0);
  EXPECT_NEAR(mean_position(scene.vertices).y, 3.5f, 1e-6);
}

TEST(Animation, ChildrenMoveWithAnimatedParentsAndOthersStayStatic) {
  GltfBuilder builder;
  const int quad = builder.quad();
  builder.node({{"name", "still"}, {"mesh", quad}});
  builder.node({{"name", "parent"}, {"children", {2}}});
  builder.node({{"name", "child"}, {"mesh", quad}, {"translation", {1, 0, 0}}});
  builder.animation(1, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, kHalf, kHalf});
  const Scene scene = builder.load();
  EXPECT_EQ(scene.static_triangle_count, 2u);
  EXPECT_EQ(scene.triangles.size(), 4u);
  // A quarter turn about z at the end of the clip; just before it, as the clip then starts again.
  const Pose posed = pose(scene, 1 - 1e-7);
  EXPECT_NEAR(glm::distance(posed.dynamic_vertices[0].position, {0, 1, 0}), 0, 1e-5);
  EXPECT_NEAR(glm::distance(glm::vec3(posed.dynamic_vertices[0].tangent), {0, 1, 0}), 0, 1e-5);
}

TEST(Animation, MorphTargetsAddUp) {
  GltfBuilder builder;
  const int positions = builder.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  const int up = builder.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  const int out = builder.accessor<float>({0, 0, 0, 2, 0, 0, 0, 0, 0}, "VEC3");
  builder.append(
      "meshes",
      {{"primitives",
        {{{"attributes", {{"POSITION", positions}}}, {"targets", {{{"POSITION", up}}, {{"POSITION", out}}}}}}},
       {"weights", {0.5, 0}}});
  const int node = builder.node({{"mesh", 0}});
  const Scene still = builder.load();
  EXPECT_FALSE(still.features.dynamic);
  EXPECT_EQ(still.vertices[0].position, glm::vec3(0, 0, 0.5f)) << "default weights of the mesh";
  builder.animation(node, "weights", {0, 2}, {0, 1, 1, 0});
  const Scene scene = builder.load();
  const Pose posed = pose(scene, 0.5);
  EXPECT_NEAR(glm::distance(posed.dynamic_vertices[1].position, {1 + 2 * 0.75f, 0, 0.25f}), 0, 1e-6);
}

TEST(Animation, FlatNormalsFollowMorphing) {
  GltfBuilder builder;
  const int positions = builder.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  const int delta = builder.accessor<float>({0, 0, 0, 0, 0, 0, 0, -1, 1}, "VEC3");
  builder.append("meshes",
                 {{"primitives", {{{"attributes", {{"POSITION", positions}}}, {"targets", {{{"POSITION", delta}}}}}}}});
  builder.animation(builder.node({{"mesh", 0}}), "weights", {0, 1}, {0, 1});
  const Scene scene = builder.load();
  EXPECT_EQ(scene.vertices[0].normal, glm::vec3(0, 0, 1));
  const Pose posed = pose(scene, 1 - 1e-7);
  EXPECT_NEAR(glm::distance(posed.dynamic_vertices[0].normal, {0, -1, 0}), 0, 1e-5);
}

/// A quad bound half to a resting and half to a moving joint; its node's own transform must not matter.
GltfBuilder skinned_quad() {
  GltfBuilder builder;
  const int mesh = builder.quad();
  auto& attributes = builder.json["meshes"][mesh]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = builder.accessor<uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4");
  attributes["WEIGHTS_0"] = builder.accessor<float>({2, 0, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 0, 3, 0, 0}, "VEC4");
  const int bind = builder.accessor<float>(
      {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -5, 0, 1}, "MAT4");
  builder.node({{"mesh", mesh}, {"skin", 0}, {"translation", {100, 0, 0}}});
  builder.node(nlohmann::json::object());
  builder.node({{"translation", {0, 5, 0}}});
  builder.append("skins", {{"joints", {1, 2}}, {"inverseBindMatrices", bind}});
  return builder;
}

TEST(Animation, SkinsBlendTheirJointsAndIgnoreTheNode) {
  GltfBuilder builder = skinned_quad();
  const Scene still = builder.load();
  EXPECT_FALSE(still.features.dynamic) << "no animation: baked in the bind pose";
  EXPECT_EQ(still.vertices[0].position, glm::vec3(0));
  builder.animation(2, "translation", {0, 1}, {0, 5, 0, 0, 5, 4});
  const Scene scene = builder.load();
  EXPECT_TRUE(scene.features.dynamic);
  const Pose posed = pose(scene, 0.5);
  EXPECT_NEAR(posed.dynamic_vertices[0].position.z, 0, 1e-6);
  EXPECT_NEAR(posed.dynamic_vertices[1].position.z, 1, 1e-6) << "weights are normalised";
  EXPECT_NEAR(posed.dynamic_vertices[3].position.z, 2, 1e-6);
}

TEST(Animation, CamerasAndLightsRideOnNodes) {
  GltfBuilder builder;
  builder.node({{"mesh", builder.quad()}});
  builder.append("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}});
  builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "spot"}, {"color", {1, 0.5, 0}}, {"intensity", 4}, {"spot", {{"outerConeAngle", 0.3}}}}};
  builder.node({{"name", "rig"},
                {"camera", 0},
                {"scale", {3, 3, 3}},
                {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  builder.animation(1, "translation", {0, 1}, {0, 0, 0, 0, 0, 8});
  const Scene scene = builder.load();
  EXPECT_FALSE(scene.features.dynamic) << "no mesh moves";
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(scene.cameras[0].name, "rig");
  ASSERT_EQ(scene.punctual.size(), 1u);
  EXPECT_EQ(scene.punctual[0].intensity, glm::vec3(4, 2, 0));
  EXPECT_TRUE(scene.features.punctual);
  const Pose posed = pose(scene, 0.25);
  EXPECT_NEAR(posed.cameras[0].world_from_camera[3].z, 2, 1e-6);
  EXPECT_NEAR(glm::length(glm::vec3(posed.cameras[0].world_from_camera[0])), 1, 1e-6) << "scale is no part of a camera";
  EXPECT_NEAR(posed.punctual[0].position.z, 2, 1e-6);
  EXPECT_EQ(posed.punctual[0].direction, glm::vec3(0, 0, -1));
}

TEST(Animation, BoundsContainTheWholeClip) {
  GltfBuilder builder;
  const int node = builder.node({{"mesh", builder.quad()}});
  builder.animation(node, "rotation", {0, 1, 2}, {0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, -1});
  const Scene scene = builder.load();
  for (double time = 0; time < 2; time += 0.0137) {
    for (const Vertex& vertex : pose(scene, time).dynamic_vertices) {
      EXPECT_TRUE(glm::all(glm::greaterThanEqual(vertex.position, scene.bounds.min)));
      EXPECT_TRUE(glm::all(glm::lessThanEqual(vertex.position, scene.bounds.max)));
    }
  }
  EXPECT_LT(scene.bounds.min.y, -1.4f);
  EXPECT_GT(scene.bounds.min.y, -1.6f);
}

}  // namespace
}  // namespace lightloom::scene
