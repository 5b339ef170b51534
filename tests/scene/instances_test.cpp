#include <gtest/gtest.h>

#include "framework/scene/load_options.hpp"
#include "framework/scene/source.hpp"
#include "tests/scene/gltf_builder.hpp"

namespace lightloom::scene {
namespace {

using nlohmann::json;

/// A scene file with so many instances of a quad that moves by 2 m and back in a second, 3 m beside each other and each
/// a little later than the one before; below a node of their own that carries a child.
class Instances : public ::testing::Test {
 protected:
  std::filesystem::path write(int count) {
    test::GltfBuilder moving;
    const int child = moving.node({{"mesh", moving.quad()}});
    const int parent = moving.node({{"children", {child}}});
    moving.json["scenes"][0]["nodes"] = {parent};
    moving.animation(parent, "translation", {0, 0.5f, 1}, {0, 0, 0, 0, 2, 0, 0, 0, 0});
    folder_.write("moving.gltf", moving.gltf());
    test::GltfBuilder still;
    still.node({{"mesh", still.quad()}});
    folder_.write("still.gltf", still.gltf());
    json instances = json::array();
    for (int k = 0; k < count; ++k)
      instances.push_back(
          {{"gltf", "moving.gltf"}, {"translation", {3.0 * k, 0, 0}}, {"time_offset_seconds", 0.01 * k}});
    return folder_.write("many.scene.json",
                         json{{"lightloom_scene", 1}, {"gltf", "still.gltf"}, {"instances", instances}}.dump());
  }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(Instances, BoundsHoldEveryPoseOfEach) {
  const Scene scene = load_scene(write(7));
  ASSERT_EQ(scene.source->draws.size(), 7u);
  for (int step = 0; step < 50; ++step) {
    for (const Vertex& vertex : pose(scene, 0.037 * step).dynamic_vertices) {
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_GE(vertex.position[axis], scene.bounds.min[axis]);
        ASSERT_LE(vertex.position[axis], scene.bounds.max[axis]);
      }
    }
  }
  EXPECT_NEAR(scene.bounds.max.x, 19, 0.2);
  EXPECT_NEAR(scene.bounds.max.y, 3, 0.2);
}

TEST_F(Instances, APartPosesAsTheWhole) {
  const Scene scene = load_scene(write(5));
  const SceneSource& source = *scene.source;
  const SceneSource part = part_of_clip(source, source.clips.at(3));
  ASSERT_EQ(part.draws.size(), 1u);
  EXPECT_EQ(part.nodes.size(), 3u);
  for (const double time : {0.0, 0.21, 0.9}) {
    std::vector<Vertex> alone(4), whole(4);
    pose_vertices(part, part.draws.front(), evaluate_nodes(part, time), alone);
    pose_vertices(source, source.draws.at(3), evaluate_nodes(source, time), whole);
    for (size_t i = 0; i < whole.size(); ++i) EXPECT_EQ(alone[i].position, whole[i].position) << time;
  }
}

/// What is posed to find the bounds is 32 moments of an instance's 4 vertices and 3 nodes, whatever else there is.
TEST_F(Instances, LookingForBoundsGrowsWithTheirNumberNotItsSquare) {
  LoadOptions options;
  for (const int count : {10, 1000}) {
    options.limits.posed_elements = 300u * static_cast<uint64_t>(count);
    EXPECT_NO_THROW((void)load_scene(write(count), options)) << count;
  }
}

}  // namespace
}  // namespace lightloom::scene
