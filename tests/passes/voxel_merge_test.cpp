#include <gtest/gtest.h>

#include "tests/passes/voxel_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

using VoxelMergeTest = DeviceTest;
constexpr std::array<const char*, 3> kParts = {"albedo", "normal", "material"};

Images merge(const std::string& settings) {
  const scene::Scene scene =
      make_triangle_scene({{glm::vec3(0), glm::vec3(3, 0, 2), glm::vec3(3, 1, 0)}}, {plain(glm::vec3(1))});
  return run_passes(R"("s": { "type": "voxel_pattern", "params": { "resolution": 24, "salt": 1, "density": 0.4 } },
      "d": { "type": "voxel_pattern", "params": { "resolution": 24, "salt": 2, "density": 0.3 } },
      "m": { "type": "voxel_merge", "in": { "static": "s.voxels", "dynamic": "d.voxels" })" +
                        settings + " }",
                    "m.voxels.albedo", scene);
}

void expect_merged(const Images& images, const std::string& winner, const std::string& other) {
  size_t both = 0;
  size_t neither = 0;
  for_each_voxel(images.at("m.voxels.albedo"), [&](const glm::ivec3& voxel) {
    const bool first = occupied(images.at(winner + ".voxels.albedo"), voxel);
    const bool second = occupied(images.at(other + ".voxels.albedo"), voxel);
    both += first && second ? 1 : 0;
    neither += first || second ? 0 : 1;
    ASSERT_EQ(occupied(images.at("m.voxels.albedo"), voxel), first || second);
    const std::string& source = first ? winner : other;
    for (const char* part : kParts)
      for (uint32_t channel = 0; channel < 4; ++channel)
        ASSERT_EQ(byte_at(images.at(std::string("m.voxels.") + part), voxel, channel),
                  byte_at(images.at(source + ".voxels." + part), voxel, channel));
  });
  EXPECT_GT(both, 100u);
  EXPECT_GT(neither, 100u);
}

TEST_F(VoxelMergeTest, DynamicVoxelsCoverStaticOnes) {
  expect_merged(merge(""), "d", "s");
}

TEST_F(VoxelMergeTest, StaticVoxelsCoverDynamicOnesIfAskedTo) {
  expect_merged(merge(R"(, "params": { "priority": "static" })"), "s", "d");
}

TEST_F(VoxelMergeTest, DisabledItPassesTheStaticVoxelsOn) {
  const Images images = merge(R"(, "enabled": false)");
  EXPECT_TRUE(images.at("output").texels == images.at("s.voxels.albedo").texels);
}

}  // namespace
}  // namespace lightloom::test
