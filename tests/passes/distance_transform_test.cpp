#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

#include "tests/passes/voxel_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

using DistanceTransformTest = DeviceTest;

scene::Scene box_scene() {
  return make_triangle_scene({{glm::vec3(0), glm::vec3(3, 0, 2), glm::vec3(3, 1, 0)}}, {plain(glm::vec3(1))});
}

Images transform(int resolution, double density, int radius, bool enabled = true) {
  const std::string passes = R"("p": { "type": "voxel_pattern", "params": { "salt": 3, "resolution": )" +
                             std::to_string(resolution) + R"(, "density": )" + std::to_string(density) +
                             R"( } }, "d": { "type": "distance_transform", "in": { "voxels": "p.voxels" },
                             "enabled": )" +
                             (enabled ? "true" : "false") + R"(, "params": { "radius": )" + std::to_string(radius) +
                             " } }";
  GraphRunOptions options;
  return run_passes(passes, "d.distance", box_scene(), options);
}

/// By definition: the nearest occupied voxel among all within the radius.
int brute_force(const image::HostImage& albedo, const glm::ivec3& voxel, int radius) {
  const glm::ivec3 extent(albedo.desc.extent.width, albedo.desc.extent.height, albedo.desc.extent.depth);
  int nearest = radius + 1;
  for (int z = std::max(voxel.z - radius, 0); z <= std::min(voxel.z + radius, extent.z - 1); ++z)
    for (int y = std::max(voxel.y - radius, 0); y <= std::min(voxel.y + radius, extent.y - 1); ++y)
      for (int x = std::max(voxel.x - radius, 0); x <= std::min(voxel.x + radius, extent.x - 1); ++x) {
        if (!occupied(albedo, {x, y, z})) continue;
        nearest = std::min(nearest, std::max({std::abs(x - voxel.x), std::abs(y - voxel.y), std::abs(z - voxel.z)}));
      }
  return nearest;
}

TEST_F(DistanceTransformTest, EqualsBruteForceBitForBit) {
  struct Case {
    int resolution;
    double density;
    int radius;
  };
  for (const Case& c : {Case{32, 0.002, 4}, Case{32, 0.05, 4}, Case{28, 0.0003, 31}, Case{24, 0.5, 2},
                        Case{24, 0.01, 1}, Case{20, 0.0, 7}, Case{20, 1.0, 7}}) {
    SCOPED_TRACE("density " + std::to_string(c.density) + ", radius " + std::to_string(c.radius));
    const Images images = transform(c.resolution, c.density, c.radius);
    const image::HostImage& albedo = images.at("p.voxels.albedo");
    const image::HostImage& distance = images.at("d.distance");
    ASSERT_EQ(distance.desc.extent, albedo.desc.extent);
    ASSERT_EQ(distance.desc.format, Format::r8_unorm);
    ASSERT_NE(albedo.desc.extent.width, albedo.desc.extent.height);
    for_each_voxel(albedo, [&](const glm::ivec3& voxel) {
      ASSERT_EQ(byte_at(distance, voxel, 0), brute_force(albedo, voxel, c.radius))
          << voxel.x << ' ' << voxel.y << ' ' << voxel.z;
    });
  }
}

TEST_F(DistanceTransformTest, NothingTakesItsPlace) {
  try {
    (void)transform(16, 0.1, 4, false);
    FAIL() << "a march without distances would meet no voxel";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("'d' is off"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace lightloom::test
