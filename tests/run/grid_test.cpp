#include "framework/run/grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace lightloom::run {
namespace {

std::array<uint32_t, 3> voxels(const Grid& grid) {
  return {grid.extent.width, grid.extent.height, grid.extent.depth};
}

TEST(Grid, LongestAxisHasTheResolutionAndOnePaddingVoxelAtEachEnd) {
  const Grid grid = make_grid({0, 0, 0}, {10, 5, 2.5f}, 12);
  EXPECT_EQ(grid.extent, (Extent3{12, 7, 5}));
  EXPECT_FLOAT_EQ(grid.voxel, 1.0f);
  EXPECT_FLOAT_EQ(grid.origin.x, -1.0f);
  EXPECT_FLOAT_EQ(grid.origin.y, -1.0f);
  EXPECT_FLOAT_EQ(grid.origin.z, -1.25f);  // 3 voxels around 2.5 m, in the middle
  EXPECT_EQ(grid_extent({0, 0, 0}, {10, 5, 2.5f}, 12), grid.extent);
}

TEST(Grid, EnclosesAnyBoundsWithAVoxelToSpareOnEverySide) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> exponent(-4, 4);
  std::uniform_real_distribution<float> unit(-1, 1);
  for (int trial = 0; trial < 2000; ++trial) {
    const float scale = std::pow(10.0f, exponent(random));
    const glm::vec3 low = scale * glm::vec3(unit(random), unit(random), unit(random));
    const glm::vec3 size = scale * glm::vec3(std::abs(unit(random)), std::abs(unit(random)), std::abs(unit(random)));
    const uint32_t resolution = 8 + static_cast<uint32_t>(trial % 505);
    const Grid grid = make_grid(low, low + size, resolution);
    const auto count = voxels(grid);
    EXPECT_EQ(std::max({count[0], count[1], count[2]}), resolution);
    for (int axis = 0; axis < 3; ++axis) {
      const float first = (low[axis] - grid.origin[axis]) / grid.voxel;
      const float last = (low[axis] + size[axis] - grid.origin[axis]) / grid.voxel;
      EXPECT_GE(first, 0.99f);
      EXPECT_LE(last, static_cast<float>(count[static_cast<size_t>(axis)]) - 0.99f);
    }
  }
}

TEST(Grid, AFlatSceneLiesInTheMiddleOfAVoxel) {
  const Grid grid = make_grid({0, 1, 0}, {4, 1, 4}, 32);
  EXPECT_EQ(grid.extent, (Extent3{32, 3, 32}));
  EXPECT_NEAR((1.0f - grid.origin.y) / grid.voxel, 1.5f, 1e-4f);
}

TEST(Grid, DegenerateBoundsGiveASmallFiniteGrid) {
  const float inf = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::array<std::array<glm::vec3, 2>, 5> cases = {{{glm::vec3(0), glm::vec3(0)},
                                                          {glm::vec3(1e6f), glm::vec3(1e6f)},
                                                          {glm::vec3(1), glm::vec3(-1)},
                                                          {glm::vec3(inf), glm::vec3(-inf)},
                                                          {glm::vec3(nan), glm::vec3(nan)}}};
  for (const auto& bounds : cases) {
    const Grid grid = make_grid(bounds[0], bounds[1], 64);
    EXPECT_EQ(grid.extent, (Extent3{3, 3, 3}));
    EXPECT_GT(grid.voxel, 0.0f);
    EXPECT_TRUE(std::isfinite(grid.voxel));
    for (int axis = 0; axis < 3; ++axis) EXPECT_TRUE(std::isfinite(grid.origin[axis]));
  }
}

}  // namespace
}  // namespace lightloom::run
