#include "framework/graph/voxel_box.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace lightloom {
namespace {

bool holds(const VoxelBox& box, int32_t x, int32_t y, int32_t z) {
  return box.low[0] <= x && x <= box.high[0] && box.low[1] <= y && y <= box.high[1] && box.low[2] <= z &&
         z <= box.high[2];
}

int64_t count(const std::vector<VoxelBox>& boxes, int32_t side) {
  int64_t inside = 0;
  for (int32_t z = 0; z < side; ++z)
    for (int32_t y = 0; y < side; ++y)
      for (int32_t x = 0; x < side; ++x)
        inside += std::count_if(boxes.begin(), boxes.end(), [&](const VoxelBox& b) { return holds(b, x, y, z); });
  return inside;
}

std::vector<VoxelBox> random_boxes(size_t number, int32_t side, int32_t longest, std::mt19937& random) {
  std::vector<VoxelBox> boxes(number);
  for (VoxelBox& box : boxes) {
    for (size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::uniform_int_distribution<int32_t>(0, side - 1)(random);
      box.high[axis] =
          std::min(box.low[axis] + std::uniform_int_distribution<int32_t>(0, longest - 1)(random), side - 1);
    }
  }
  return boxes;
}

TEST(VoxelBox, VolumeCountsVoxels) {
  EXPECT_EQ(volume(VoxelBox{}), 0);
  EXPECT_EQ(volume(VoxelBox{{2, 3, 4}, {2, 3, 4}}), 1);
  EXPECT_EQ(volume(VoxelBox{{0, 0, 0}, {1, 2, 3}}), 24);
  EXPECT_EQ(volume(VoxelBox{{0, 5, 0}, {1, 2, 3}}), 0);
  EXPECT_EQ(volume(whole_grid({2048, 2048, 2048})), int64_t{1} << 33);
}

TEST(VoxelBox, DilationStopsAtTheGrid) {
  EXPECT_EQ(dilated({{1, 5, 9}, {2, 6, 9}}, {3, 1, 2}, {10, 10, 10}), (VoxelBox{{0, 4, 7}, {5, 7, 9}}));
  EXPECT_EQ(dilated({{1, 5, 9}, {2, 6, 9}}, {0, 0, 0}, {10, 10, 10}), (VoxelBox{{1, 5, 9}, {2, 6, 9}}));
}

TEST(VoxelBox, MergedBoxesAreDisjointFewAndHoldEverything) {
  std::mt19937 random(5);
  constexpr int32_t kSide = 24;
  for (int trial = 0; trial < 200; ++trial) {
    const size_t limit = 1 + static_cast<size_t>(trial % 16);
    const std::vector<VoxelBox> boxes = random_boxes(static_cast<size_t>(trial % 40), kSide, 1 + trial % 7, random);
    const std::vector<VoxelBox> few = merged(boxes, limit);
    ASSERT_LE(few.size(), limit);
    for (const VoxelBox& box : boxes)
      ASSERT_TRUE(std::any_of(few.begin(), few.end(), [&](const VoxelBox& big) { return united(big, box) == big; }));
    for (size_t i = 0; i < few.size(); ++i)
      for (size_t j = i + 1; j < few.size(); ++j) ASSERT_FALSE(overlap(few[i], few[j]));
    ASSERT_EQ(count(few, kSide), volume(few));
  }
}

TEST(VoxelBox, BoxesFarApartStayApart) {
  const std::vector<VoxelBox> apart = {{{0, 0, 0}, {3, 3, 3}}, {{20, 0, 0}, {23, 3, 3}}, {{0, 20, 0}, {3, 23, 3}}};
  EXPECT_EQ(volume(merged(apart, 16)), 3 * 64);
  EXPECT_EQ(merged(apart, 2).size(), 2u);
  EXPECT_TRUE(merged({VoxelBox{}}, 16).empty());
}

TEST(VoxelBox, ThousandsOfBoxesAreMergedToo) {
  std::mt19937 random(6);
  const std::vector<VoxelBox> few = merged(random_boxes(5000, 512, 4, random), 16);
  EXPECT_LE(few.size(), 16u);
  EXPECT_FALSE(few.empty());
}

}  // namespace
}  // namespace lightloom
