#include <gtest/gtest.h>

#include <cstring>

#include "tests/passes/voxel_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

using VoxelizeRasterTest = DeviceTest;

// Rasterizers keep corners in steps of at most 1/16 pixel (Vulkan's least precision) and round half a step, on x and y;
// nearer to an edge, to the next voxel, or to another dominant axis than that, either answer is right.
constexpr double kBorder = 0.05;

enum class Answer : uint8_t { no, yes, unclear };

/// Signed distance of a point from the line through p and q [voxels].
double distance_from_line(const glm::dvec2& point, const glm::dvec2& p, const glm::dvec2& q) {
  const glm::dvec2 along = q - p;
  const glm::dvec2 to = point - p;
  return (along.x * to.y - along.y * to.x) / std::max(glm::length(along), 1e-30);
}

/// Is the voxel where the triangle meets the line through the voxel's centre along `axis`? By barycentric coordinates
/// of the line's foot in double precision.
Answer sampled_along(const GridTriangle& t, const glm::ivec3& voxel, int axis) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  const auto flat = [&](const glm::dvec3& p) { return glm::dvec2(p[u], p[v]); };
  const glm::dvec2 point = flat(glm::dvec3(voxel) + 0.5);
  const glm::dvec3 weights(distance_from_line(point, flat(t[1]), flat(t[2])),
                           distance_from_line(point, flat(t[2]), flat(t[0])),
                           distance_from_line(point, flat(t[0]), flat(t[1])));
  const double inner = std::min({weights.x, weights.y, weights.z});
  const double outer = std::max({weights.x, weights.y, weights.z});
  const double depth = std::max(inner, -outer);  // how far inside, whichever way the corners run
  if (depth < -kBorder) return Answer::no;
  const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  const glm::dvec2 offset = point - flat(t[0]);
  const double height = t[0][axis] - (normal[u] * offset.x + normal[v] * offset.y) / normal[axis];
  const double above = height - voxel[axis];
  if (above < -kBorder || above > 1 + kBorder) return Answer::no;
  const bool clear = depth > kBorder && above > 1e-3 && above < 1 - 1e-3;
  return clear ? Answer::yes : Answer::unclear;
}

Answer sampled(const GridTriangle& t, const glm::ivec3& voxel) {
  const glm::dvec3 normal = glm::abs(glm::cross(t[1] - t[0], t[2] - t[0]));
  const double largest = std::max({normal.x, normal.y, normal.z});
  if (largest < 1e-9) return Answer::unclear;
  std::vector<Answer> answers;
  for (int axis = 0; axis < 3; ++axis)
    if (normal[axis] > largest * (1 - 1e-5)) answers.push_back(sampled_along(t, voxel, axis));
  const bool agreed = std::all_of(answers.begin(), answers.end(), [&](Answer a) { return a == answers.front(); });
  return agreed ? answers.front() : Answer::unclear;
}

/// A colour that tells a triangle from all others after the square root coding, in 8 bits a channel.
glm::vec3 color_of(size_t triangle) {
  const glm::vec3 code(static_cast<float>(triangle % 16) * 16, static_cast<float>(triangle / 16) * 16, 100);
  return (code / 255.0f) * (code / 255.0f);
}

scene::Scene colored_scene(const std::vector<WorldTriangle>& triangles) {
  std::vector<scene::Material> materials;
  for (size_t i = 0; i < std::min<size_t>(triangles.size(), 256); ++i) materials.push_back(plain(color_of(i)));
  return make_triangle_scene(triangles, materials);
}

Images rasterize(const scene::Scene& scene, int resolution) {
  return run_passes(R"("v": { "type": "voxelize", "params": { "coverage": "raster", "resolution": )" +
                        std::to_string(resolution) + " } }",
                    "v.voxels.albedo", scene);
}

int owner_at(const Images& images, const glm::ivec3& voxel) {
  const glm::uvec3 at(voxel);
  const image::HostImage& owner = images.at("v.owner");
  const size_t index = (size_t{at.z} * owner.desc.extent.height + at.y) * owner.desc.extent.width + at.x;
  uint32_t value = 0;
  std::memcpy(&value, owner.texels.data() + index * sizeof value, sizeof value);
  return static_cast<int>(value) - 1;
}

/// Returns the number of voxels whose owner was compared.
size_t expect_sampled_owners(const std::vector<WorldTriangle>& triangles, int resolution) {
  const scene::Scene scene = colored_scene(triangles);
  const run::Grid grid = run::make_grid(scene.bounds.min, scene.bounds.max, static_cast<uint32_t>(resolution));
  std::vector<GridTriangle> in_voxels;
  for (const WorldTriangle& triangle : triangles) in_voxels.push_back(in_grid(grid, triangle));
  const Images images = rasterize(scene, resolution);
  size_t compared = 0;
  for_each_voxel(images.at("v.voxels.albedo"), [&](const glm::ivec3& voxel) {
    const int owner = owner_at(images, voxel);
    ASSERT_EQ(occupied(images.at("v.voxels.albedo"), voxel), owner >= 0);
    if (owner >= 0) {
      ASSERT_NE(sampled(in_voxels[static_cast<size_t>(owner)], voxel), Answer::no) << owner;
      ASSERT_EQ(byte_at(images.at("v.voxels.albedo"), voxel, 0), owner % 256 % 16 * 16);
    }
    for (int later = static_cast<int>(triangles.size()) - 1; later > owner; --later)
      ASSERT_NE(sampled(in_voxels[static_cast<size_t>(later)], voxel), Answer::yes)
          << "triangle " << later << " lost to " << owner << " at " << voxel.x << ' ' << voxel.y << ' ' << voxel.z;
    compared += owner >= 0 && sampled(in_voxels[static_cast<size_t>(owner)], voxel) == Answer::yes ? 1 : 0;
  });
  return compared;
}

TEST_F(VoxelizeRasterTest, AVoxelBelongsToTheLastTriangleThatMeetsItsColumnsCentreThere) {
  EXPECT_GT(expect_sampled_owners(random_triangles(40, 3.0f, 1), 32), 1000u);
  EXPECT_GT(expect_sampled_owners(random_triangles(200, 0.6f, 2), 40), 400u);
  EXPECT_GT(
      expect_sampled_owners(cube_triangles(1, glm::mat3_cast(glm::angleAxis(0.7f, glm::vec3(0.6f, 0, 0.8f)))), 24),
      500u);
}

TEST_F(VoxelizeRasterTest, ItTakesFewerVoxelsThanSupercoverAndNoneOfItsOwn) {
  const scene::Scene scene = colored_scene(random_triangles(100, 1.5f, 3));
  const Images raster = rasterize(scene, 40);
  const Images cover = voxelize(scene, 40);
  size_t only_raster = 0;
  size_t only_cover = 0;
  size_t both = 0;
  for_each_voxel(raster.at("v.voxels.albedo"), [&](const glm::ivec3& voxel) {
    const bool in_raster = occupied(raster.at("v.voxels.albedo"), voxel);
    const bool in_cover = occupied(cover.at("v.voxels.albedo"), voxel);
    both += in_raster && in_cover ? 1 : 0;
    only_cover += in_cover && !in_raster ? 1 : 0;
    only_raster += in_raster && !in_cover ? 1 : 0;
  });
  EXPECT_GT(both, 1000u);
  EXPECT_GT(only_cover, both / 4);
  EXPECT_LE(only_raster, both / 1000);  // where the hardware's rounding of corners reaches over an edge
}

TEST_F(VoxelizeRasterTest, EveryRunGivesTheSameBits) {
  const scene::Scene scene = colored_scene(random_triangles(300, 1.0f, 6));
  const Images first = rasterize(scene, 48);
  for (int run = 0; run < 2; ++run) {
    const Images again = rasterize(scene, 48);
    for (const char* part : {"v.voxels.albedo", "v.voxels.normal", "v.voxels.material", "v.owner"})
      EXPECT_TRUE(first.at(part).texels == again.at(part).texels) << part;
  }
}

TEST_F(VoxelizeRasterTest, CoarsestAndFinestGridsOfBothCoverages) {
  // A long thin box, so that the finest grid is small.
  std::vector<WorldTriangle> triangles = cube_triangles(1, glm::mat3(1));
  for (WorldTriangle& triangle : triangles)
    for (glm::vec3& corner : triangle) corner *= glm::vec3(100, 1, 2);
  const scene::Scene scene = colored_scene(triangles);
  EXPECT_GT(expect_sampled_owners(triangles, 512), 500u);
  for (const int resolution : {8, 512}) {
    const Images cover = voxelize(scene, resolution);
    const Images raster = rasterize(scene, resolution);
    const image::HostImage& albedo = cover.at("v.voxels.albedo");
    ASSERT_EQ(albedo.desc.extent.width, static_cast<uint32_t>(resolution));
    ASSERT_LT(albedo.desc.extent.height, 12u);
    // Every slice across the box is walled; the first and the last one are padding.
    for (int x = 1; x < resolution - 1; ++x) {
      size_t in_cover = 0;
      size_t in_raster = 0;
      for_each_voxel(albedo, [&](const glm::ivec3& voxel) {
        if (voxel.x != x) return;
        in_cover += occupied(albedo, voxel) ? 1 : 0;
        in_raster += occupied(raster.at("v.voxels.albedo"), voxel) ? 1 : 0;
      });
      ASSERT_GT(in_raster, 0u) << x;
      ASSERT_LE(in_raster, in_cover) << x;
    }
  }
}

TEST_F(VoxelizeRasterTest, CutOutTexelsClaimNothing) {
  scene::Material material = plain(glm::vec3(1));
  material.base_color_texture.image = 0;
  material.base_color_texture.nearest = true;
  material.alpha_mode = scene::AlphaMode::mask;
  scene::Scene scene = make_quad_scene({{{0, 0, 4}, {4, 0, 0}, {0, 0, -4}, 0}}, {material},
                                       look_at({2, 5, 2}, {2, 0, 2}, 0.8f, {0, 0, -1}));
  scene.images = {make_image(64, 64, [](uint32_t x, uint32_t) {
    return std::array<uint8_t, 4>{255, 255, 255, uint8_t(x < 32 ? 255 : 0)};
  })};
  scene.features.textured = true;
  scene.features.alpha = true;
  const Images images = rasterize(scene, 34);
  const image::HostImage& albedo = images.at("v.voxels.albedo");
  for (int x = 2; x < 32; ++x) {
    if (std::abs(x - 17) <= 2) continue;  // the texture's filter blurs its border
    EXPECT_EQ(occupied(albedo, {x, 1, 9}), x < 17) << x;
  }
}

}  // namespace
}  // namespace lightloom::test
