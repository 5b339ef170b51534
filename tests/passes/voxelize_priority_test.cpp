// Which of the triangles that claim a voxel owns it.
#include <gtest/gtest.h>

#include "tests/passes/voxel_support.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/graph_runner.hpp"

namespace lightloom::test {
namespace {

class VoxelizePriorityTest : public DeviceTest {};

/// A lamp 0.2 m wide and 1 mm below a ceiling of 1 m that is drawn after it.
scene::Scene lamp_below_ceiling(bool lamp_is_lit) {
  scene::Material lamp = white_lambertian();
  if (lamp_is_lit) lamp.emission = glm::vec3(5);
  scene::Scene scene =
      make_quad_scene({{{0.4f, 0.499f, 0.4f}, {0.2f, 0, 0}, {0, 0, 0.2f}, 0}, {{0, 0.5f, 0}, {1, 0, 0}, {0, 0, 1}, 1}},
                      {lamp, white_lambertian()}, look_at({0.5f, 0, 0.5f}, {0.5f, 0.5f, 0.5f}, 1, {0, 0, 1}));
  scene.features.emissive = lamp_is_lit;
  return scene;
}

size_t emissive_voxels(const scene::Scene& scene, const std::string& coverage, const std::string& priority) {
  const Images images = run_passes(R"("v": { "type": "voxelize", "params": { "resolution": 32, "coverage": ")" +
                                       coverage + R"(", "priority": ")" + priority + R"(" } })",
                                   "v.voxels.albedo", scene);
  const image::HostImage& material = images.at("v.voxels.material");
  size_t count = 0;
  for_each_voxel(material, [&](const glm::ivec3& voxel) { count += byte_at(material, voxel, 3) > 0 ? 1 : 0; });
  return count;
}

TEST_F(VoxelizePriorityTest, ALampCloserToACeilingThanAVoxelKeepsItsVoxelsIfEmissiveTrianglesComeFirst) {
  const scene::Scene scene = lamp_below_ceiling(true);
  for (const char* coverage : {"raster", "supercover"}) {
    EXPECT_EQ(emissive_voxels(scene, coverage, "draw_order"), 0u) << coverage;
    // 0.2 m are six voxels, and a part of one on each side.
    EXPECT_GE(emissive_voxels(scene, coverage, "emissive"), 36u) << coverage;
    EXPECT_LE(emissive_voxels(scene, coverage, "emissive"), 64u) << coverage;
  }
}

TEST_F(VoxelizePriorityTest, WithoutEmissionItChangesNothing) {
  const scene::Scene scene = lamp_below_ceiling(false);
  const auto voxels = [&](const std::string& priority) {
    return run_passes(
        R"("v": { "type": "voxelize", "params": { "resolution": 32, "priority": ")" + priority + R"(" } })",
        "v.voxels.albedo", scene);
  };
  const Images last = voxels("draw_order");
  const Images first = voxels("emissive");
  for (const char* name : {"v.owner", "v.voxels.albedo", "v.voxels.normal", "v.voxels.material"})
    EXPECT_TRUE(last.at(name).texels == first.at(name).texels) << name;
}

}  // namespace
}  // namespace lightloom::test
