#include "framework/run/moved_boxes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "framework/run/grid.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/snippet_runner.hpp"

namespace lightloom::run {
namespace {

/// A scene of `objects` triangles that move, after one that does not.
scene::Scene moving_triangles(uint32_t objects) {
  scene::Scene made;
  for (uint32_t i = 0; i <= objects; ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      scene::Vertex vertex;
      vertex.position = glm::vec3(i, corner == 1 ? 1 : 0, corner == 2 ? 1 : 0);
      made.vertices.push_back(vertex);
    }
    made.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2, 0, i});
  }
  made.static_vertex_count = 3;
  made.static_triangle_count = 1;
  return made;
}

std::vector<scene::Vertex> dynamic_vertices(const scene::Scene& scene) {
  return {scene.vertices.begin() + scene.static_vertex_count, scene.vertices.end()};
}

TEST(MovingObjects, OnlyWhatChangedHasMoved) {
  const scene::Scene scene = moving_triangles(3);
  MovingObjects objects(scene);
  std::vector<scene::Vertex> vertices = dynamic_vertices(scene);
  objects.update(vertices);
  EXPECT_EQ(objects.moved().size(), 3u);  // all are new
  objects.update(vertices);
  EXPECT_TRUE(objects.moved().empty());
  vertices[4].position.x += 2;
  objects.update(vertices);
  ASSERT_EQ(objects.moved().size(), 2u);
  EXPECT_EQ(objects.moved()[0].max, glm::vec3(2, 1, 1));  // as it was
  EXPECT_EQ(objects.moved()[1].min, glm::vec3(2, 0, 0));  // as it is
  EXPECT_EQ(objects.moved()[1].max, glm::vec3(4, 1, 1));
  vertices[7].u0 = 0.5f;  // no corner moved, but it looks different
  objects.update(vertices);
  EXPECT_EQ(objects.moved().size(), 2u);
}

TEST(MovedBoxes, HoldWhatIsThereWithAVoxelAroundIt) {
  const scene::Bounds room{glm::vec3(0), glm::vec3(10, 6, 8)};
  const Extent3 extent = grid_extent(room.min, room.max, 12);  // voxels of 1 m, one of padding
  const auto boxes = moved_boxes(room, extent, {{glm::vec3(4.5f, 2.5f, 3.5f), glm::vec3(5.5f, 2.5f, 3.5f)}});
  EXPECT_EQ(boxes, (std::vector<VoxelBox>{{{4, 2, 3}, {7, 4, 5}}}));
}

TEST(MovedBoxes, AreClippedToTheGrid) {
  const scene::Bounds room{glm::vec3(0), glm::vec3(10, 6, 8)};
  const Extent3 extent = grid_extent(room.min, room.max, 12);
  const float far = std::numeric_limits<float>::max();
  EXPECT_TRUE(moved_boxes(room, extent, {{glm::vec3(20), glm::vec3(30)}}).empty());
  EXPECT_TRUE(moved_boxes(room, extent, {{glm::vec3(-far), glm::vec3(-5)}}).empty());
  EXPECT_TRUE(moved_boxes(room, extent, {}).empty());
  const VoxelBox whole{{0, 0, 0}, {11, 7, 9}};
  EXPECT_EQ(moved_boxes(room, extent, {{glm::vec3(-far), glm::vec3(far)}}), (std::vector<VoxelBox>{whole}));
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(moved_boxes(room, extent, {{glm::vec3(-infinity), glm::vec3(infinity)}}), (std::vector<VoxelBox>{whole}));
  EXPECT_TRUE(moved_boxes(room, extent, {{glm::vec3(infinity), glm::vec3(-infinity)}}).empty());
}

TEST(MovedBoxes, ManyObjectsGiveFewBoxes) {
  const scene::Bounds room{glm::vec3(0), glm::vec3(100)};
  std::mt19937 random(2);
  std::uniform_real_distribution<float> place(0, 99);
  std::vector<scene::Bounds> moved;
  for (int i = 0; i < 300; ++i) {
    const glm::vec3 low(0.2f * place(random) + (i % 2 == 0 ? 0.0f : 79.0f), place(random), place(random));
    moved.push_back({low, low + 1.0f});
  }
  const auto boxes = moved_boxes(room, grid_extent(room.min, room.max, 256), moved);
  EXPECT_GT(boxes.size(), 1u);  // those on the left and those on the right do not become one
  EXPECT_LE(boxes.size(), 16u);
}

TEST(MovedBoxes, TheGridAroundGivenBoundsIsTheOneThatMadeTheExtent) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(-1, 1);
  for (int trial = 0; trial < 500; ++trial) {
    const glm::vec3 low = std::pow(10.0f, 3 * unit(random)) * glm::vec3(unit(random), unit(random), unit(random));
    const glm::vec3 high = low + glm::abs(glm::vec3(unit(random), unit(random), unit(random)));
    const Grid made = make_grid(low, high, 8 + static_cast<uint32_t>(trial));
    const Grid again = grid_around(low, high, made.extent);
    EXPECT_NEAR(again.voxel, made.voxel, 1e-6f * made.voxel);
    EXPECT_LT(glm::distance(again.origin, made.origin), 1e-6f * glm::length(glm::abs(low) + glm::abs(high)));
  }
}

using MovedBoxesOnDevice = test::DeviceTest;

TEST_F(MovedBoxesOnDevice, ShadersSeeTheSameGrid) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> unit(-1, 1);
  std::vector<float> inputs;
  std::vector<Grid> grids;
  for (int trial = 0; trial < 100; ++trial) {
    const glm::vec3 low(10 * unit(random), unit(random), 5 * unit(random));
    const glm::vec3 high = low + 4.0f * glm::abs(glm::vec3(unit(random), unit(random), unit(random)));
    const Extent3 extent = grid_extent(low, high, 8 + static_cast<uint32_t>(trial) * 5);
    grids.push_back(grid_around(low, high, extent));
    for (const float value : {low.x, low.y, low.z, high.x, high.y, high.z}) inputs.push_back(value);
    for (const uint32_t value : {extent.width, extent.height, extent.depth})
      inputs.push_back(static_cast<float>(value));
  }
  const std::vector<float> got = test::run_snippet(device(), R"(
#include "lib/grid.glsl"
vec3 input_vector(uint at) { return vec3(inputs[at], inputs[at + 1], inputs[at + 2]); }
void evaluate(uint index) {
  uint at = 9 * index;
  Grid grid = grid_around(input_vector(at), input_vector(at + 3), ivec3(input_vector(at + 6)));
  for (int axis = 0; axis < 3; ++axis) outputs[4 * index + axis] = grid.origin[axis];
  outputs[4 * index + 3] = grid.voxel_size;
})",
                                                   inputs, grids.size() * 4, static_cast<uint32_t>(grids.size()));
  for (size_t i = 0; i < grids.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(got[4 * i + static_cast<size_t>(axis)], grids[i].origin[axis], 1e-5f);
    EXPECT_NEAR(got[4 * i + 3], grids[i].voxel, 1e-6f * grids[i].voxel);
  }
}

}  // namespace
}  // namespace lightloom::run
