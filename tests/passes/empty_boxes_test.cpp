#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "tests/passes/voxel_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

using EmptyBoxes = DeviceTest;

scene::Scene wide_scene() {
  return make_triangle_scene({{glm::vec3(0), glm::vec3(3, 0, 2), glm::vec3(3, 1, 0)}}, {plain(glm::vec3(1))});
}

Images boxes_of(int resolution, double density, int radius) {
  return run_passes(
      R"("p": { "type": "voxel_pattern", "params": { "salt": 5, "resolution": )" + std::to_string(resolution) +
          R"(, "density": )" + std::to_string(density) +
          R"( } }, "d": { "type": "distance_transform", "in": { "voxels": "p.voxels" }, "params": { "radius": )" +
          std::to_string(radius) + R"( } }, "b": { "type": "empty_boxes", "in": { "distance": "d.distance" } })",
      "b.boxes", wide_scene());
}

/// Edges of the box of a voxel for the signs of a direction (bit a: coordinate a falls), by the port's documentation;
/// `size`: of the grid.
glm::ivec3 edges(const image::HostImage& boxes, const glm::ivec3& size, const glm::ivec3& voxel, int signs) {
  const glm::uvec3 at(voxel + glm::ivec3(0, signs & 2 ? size.y : 0, signs & 4 ? size.z : 0));
  const auto word = static_cast<uint32_t>(boxes.at(at.x, at.y, at.z, 0));
  const uint32_t code = signs & 1 ? word >> 16U : word & 0xffffU;
  return {code % 32, code / 32 % 32, code / 1024};
}

int occupied_in(const image::HostImage& albedo, const glm::ivec3& low, const glm::ivec3& high) {
  int count = 0;
  for (int z = low.z; z <= high.z; ++z)
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x) count += occupied(albedo, {x, y, z}) ? 1 : 0;
  return count;
}

struct Case {
  int resolution;
  double density;
  int radius;
};

TEST_F(EmptyBoxes, AreEmptyWithinTheGridAndNoSmallerThanTheCube) {
  for (const Case& c : {Case{24, 0.01, 4}, Case{20, 0.2, 2}, Case{24, 0.001, 31}, Case{16, 0.0, 4}, Case{16, 1.0, 4}}) {
    SCOPED_TRACE("density " + std::to_string(c.density) + ", radius " + std::to_string(c.radius));
    const Images images = boxes_of(c.resolution, c.density, c.radius);
    const image::HostImage& albedo = images.at("p.voxels.albedo");
    const image::HostImage& boxes = images.at("b.boxes");
    const glm::ivec3 size(albedo.desc.extent.width, albedo.desc.extent.height, albedo.desc.extent.depth);
    ASSERT_EQ(boxes.desc.extent,
              (Extent3{albedo.desc.extent.width, 2 * albedo.desc.extent.height, 2 * albedo.desc.extent.depth}));
    for_each_voxel(albedo, [&](const glm::ivec3& voxel) {
      const int cube = byte_at(images.at("d.distance"), voxel, 0);
      for (int signs = 0; signs < 8; ++signs) {
        const glm::ivec3 box = edges(boxes, size, voxel, signs);
        ASSERT_EQ(box == glm::ivec3(0), occupied(albedo, voxel));
        if (box == glm::ivec3(0)) continue;
        glm::ivec3 low = voxel, high = voxel;
        for (int a = 0; a < 3; ++a) (signs >> a & 1 ? low[a] : high[a]) += (signs >> a & 1 ? 1 : -1) * (1 - box[a]);
        ASSERT_TRUE(glm::all(glm::greaterThanEqual(box, glm::ivec3(1))));
        ASSERT_TRUE(glm::all(glm::greaterThanEqual(low, glm::ivec3(0))) && glm::all(glm::lessThan(high, size)));
        ASSERT_EQ(occupied_in(albedo, low, high), 0) << voxel.x << ' ' << voxel.y << ' ' << voxel.z << ' ' << signs;
        double own = 0, given = 0;
        for (int a = 0; a < 3; ++a) {
          own += 1.0 / box[a];
          given += 1.0 / std::min({cube, 31, signs >> a & 1 ? voxel[a] + 1 : size[a] - voxel[a]});
        }
        ASSERT_LE(own, given * (1 + 1e-6));
      }
    });
  }
}

/// Beside a wall a cube has an edge of one voxel; a box reaches along the wall and away from it.
TEST_F(EmptyBoxes, ReachAlongAWall) {
  const Images images = run_passes(
      R"("v": { "type": "voxelize", "params": { "resolution": 24 } },
         "d": { "type": "distance_transform", "in": { "voxels": "v.voxels" } },
         "b": { "type": "empty_boxes", "in": { "distance": "d.distance" } })",
      "b.boxes",
      make_triangle_scene({{glm::vec3(0, 0, 0), glm::vec3(4, 0, 0), glm::vec3(0, 0, 4)},
                           {glm::vec3(4, 0, 0), glm::vec3(4, 0, 4), glm::vec3(0, 0, 4)},
                           {glm::vec3(0, 4, 0), glm::vec3(0.01f, 4, 0), glm::vec3(0, 4, 0.01f)}},
                          {plain(glm::vec3(1))}));
  const image::HostImage& albedo = images.at("v.voxels.albedo");
  const glm::ivec3 size(albedo.desc.extent.width, albedo.desc.extent.height, albedo.desc.extent.depth);
  glm::ivec3 above(size.x / 2, 0, size.z / 2);
  while (!occupied(albedo, above)) ++above.y;
  while (occupied(albedo, above)) ++above.y;
  EXPECT_EQ(byte_at(images.at("d.distance"), above, 0), 1);
  const glm::ivec3 up = edges(images.at("b.boxes"), size, above, 0);
  EXPECT_GE(up.x, size.x - above.x);
  EXPECT_GE(up.z, size.z - above.z);
  EXPECT_GE(up.y, size.y / 2);
  const glm::ivec3 down = edges(images.at("b.boxes"), size, above, 2);
  EXPECT_EQ(down.y, 1);
  EXPECT_GE(down.x, size.x - above.x);
}

TEST_F(EmptyBoxes, AreMissedByNobodyWhereTheyAreOff) {
  // An optional input of the tracer: it marches by distances then, and finds the same.
  EXPECT_NO_THROW((void)run_passes(
      R"("v": { "type": "voxelize", "params": { "resolution": 16 } },
         "d": { "type": "distance_transform", "in": { "voxels": "v.voxels" } },
         "b": { "type": "empty_boxes", "in": { "distance": "d.distance" }, "enabled": false },
         "gather": { "type": "gather" },
         "t": { "type": "voxel_path_trace", "in": { "surface": "gather.surface", "voxels": "v.voxels",
                "distance": "d.distance", "boxes": "b.boxes" }, "params": { "march": "box_exit" } })",
      "t.radiance", wide_scene()));
}

}  // namespace
}  // namespace lightloom::test
