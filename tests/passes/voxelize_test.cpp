#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/passes/voxel_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

using VoxelizeTest = DeviceTest;
constexpr double kBorder = 1e-4;  // voxels

run::Grid grid_of(const scene::Scene& scene, int resolution) {
  return run::make_grid(scene.bounds.min, scene.bounds.max, static_cast<uint32_t>(resolution));
}

/// Last triangle that touches the voxel, -1 for none; -2 where a triangle that matters is too close to tell.
int expected_owner(const std::vector<GridTriangle>& triangles, const glm::ivec3& voxel) {
  for (int i = static_cast<int>(triangles.size()) - 1; i >= 0; --i) {
    const GridTriangle& triangle = triangles[static_cast<size_t>(i)];
    if (touches_voxel(triangle, voxel, -kBorder)) return i;
    if (touches_voxel(triangle, voxel, kBorder)) return -2;
  }
  return -1;
}

/// A colour that tells a triangle from all others after the square root coding, in 8 bits a channel.
glm::vec3 color_of(int triangle) {
  const glm::vec3 code(static_cast<float>(triangle % 16) * 16, static_cast<float>(triangle / 16) * 16, 100);
  return (code / 255.0f) * (code / 255.0f);
}

void expect_owners(const std::vector<WorldTriangle>& triangles, int resolution) {
  std::vector<scene::Material> materials;
  for (size_t i = 0; i < triangles.size(); ++i) materials.push_back(plain(color_of(static_cast<int>(i))));
  const scene::Scene scene = make_triangle_scene(triangles, materials);
  const run::Grid grid = grid_of(scene, resolution);
  std::vector<GridTriangle> grid_triangles;
  for (const WorldTriangle& triangle : triangles) grid_triangles.push_back(in_grid(grid, triangle));
  const Images images = voxelize(scene, resolution);
  const image::HostImage& albedo = images.at("v.voxels.albedo");
  ASSERT_EQ(albedo.desc.extent, grid.extent);
  size_t unclear = 0;
  for_each_voxel(albedo, [&](const glm::ivec3& voxel) {
    const int expected = expected_owner(grid_triangles, voxel);
    if (expected == -2) {
      ++unclear;
    } else if (expected == -1) {
      ASSERT_FALSE(occupied(albedo, voxel)) << voxel.x << ' ' << voxel.y << ' ' << voxel.z;
    } else {
      ASSERT_TRUE(occupied(albedo, voxel)) << voxel.x << ' ' << voxel.y << ' ' << voxel.z;
      ASSERT_EQ(byte_at(albedo, voxel, 0) + byte_at(albedo, voxel, 1), 16 * (expected % 16 + expected / 16));
    }
  });
  EXPECT_LT(unclear, 40u);
}

TEST_F(VoxelizeTest, EveryTouchedVoxelBelongsToTheLastTriangleThatTouchesIt) {
  expect_owners(random_triangles(60, 3.0f, 1), 32);    // far more columns than one thread takes
  expect_owners(random_triangles(200, 0.4f, 2), 40);   // a few voxels
  expect_owners(random_triangles(200, 0.01f, 3), 32);  // far less than a voxel
}

TEST_F(VoxelizeTest, ManyTrianglesOfAllSizesInOneDispatch) {
  std::vector<WorldTriangle> triangles = random_triangles(3000, 0.05f, 4);
  const std::vector<WorldTriangle> large = random_triangles(10, 4.0f, 5);
  triangles.insert(triangles.begin() + 1500, large.begin(), large.end());
  const scene::Scene scene = make_triangle_scene(triangles, {plain(glm::vec3(1))});
  const run::Grid grid = grid_of(scene, 24);
  const Images images = voxelize(scene, 24);
  const image::HostImage& albedo = images.at("v.voxels.albedo");
  for_each_voxel(albedo, [&](const glm::ivec3& voxel) {
    bool may = false;
    bool must = false;
    for (const WorldTriangle& triangle : triangles) {
      const GridTriangle t = in_grid(grid, triangle);
      may = may || touches_voxel(t, voxel, kBorder);
      must = must || (may && touches_voxel(t, voxel, -kBorder));
      if (must) break;
    }
    if (must == may) {
      ASSERT_EQ(occupied(albedo, voxel), must);
    }
  });
}

TEST_F(VoxelizeTest, AClosedTurnedCubeHasNoHolesEvenDiagonally) {
  const glm::mat3 rotation(glm::rotate(glm::mat4(1), 0.7f, glm::normalize(glm::vec3(1, 2, 3))));
  const scene::Scene scene = make_triangle_scene(cube_triangles(1, rotation), {plain(glm::vec3(1))});
  const Images images = voxelize(scene, 40);
  const image::HostImage& albedo = images.at("v.voxels.albedo");
  const Extent3 extent = albedo.desc.extent;
  const auto index = [&](const glm::ivec3& v) {
    return (static_cast<size_t>(v.z) * extent.height + static_cast<size_t>(v.y)) * extent.width +
           static_cast<size_t>(v.x);
  };
  // Flood from the middle through all 26 neighbours.
  std::vector<bool> seen(size_t{extent.width} * extent.height * extent.depth);
  const glm::ivec3 middle(extent.width / 2, extent.height / 2, extent.depth / 2);
  std::vector<glm::ivec3> open = {middle};
  ASSERT_FALSE(occupied(albedo, middle));
  seen[index(middle)] = true;
  size_t inside = 0;
  while (!open.empty()) {
    const glm::ivec3 at = open.back();
    open.pop_back();
    ++inside;
    for (int k = 0; k < 27; ++k) {
      const glm::ivec3 next = at + glm::ivec3(k % 3, k / 3 % 3, k / 9) - 1;
      const glm::ivec3 last = glm::ivec3(extent.width, extent.height, extent.depth) - 1;
      ASSERT_TRUE(glm::all(glm::greaterThanEqual(next, glm::ivec3(0))) && glm::all(glm::lessThanEqual(next, last)))
          << "the flood escaped";
      if (occupied(albedo, next) || seen[index(next)]) continue;
      seen[index(next)] = true;
      open.push_back(next);
    }
  }
  EXPECT_GT(inside, 1000u);
}

TEST_F(VoxelizeTest, EveryRunGivesTheSameBits) {
  const std::vector<WorldTriangle> triangles = random_triangles(300, 1.0f, 6);
  std::vector<scene::Material> materials;
  for (int i = 0; i < 200; ++i) materials.push_back(plain(color_of(i)));
  const scene::Scene scene = make_triangle_scene(triangles, materials);
  const Images first = voxelize(scene, 48);
  for (int run = 0; run < 3; ++run) {
    const Images again = voxelize(scene, 48);
    for (const char* part : {"v.voxels.albedo", "v.voxels.normal", "v.voxels.material", "v.owner"})
      EXPECT_TRUE(first.at(part).texels == again.at(part).texels) << part;
  }
}

TEST_F(VoxelizeTest, WordsHoldTheMaterial) {
  scene::Material material;
  material.base_color = {0.25f, 0.5f, 1.0f, 1};
  material.metallic = 0.5f;
  material.roughness = 0.5f;  // alpha 0.25
  material.ior = 1.5f;
  material.specular_factor = 0.5f;
  material.emission = glm::vec3(3, 2, 1);
  scene::Material dark = plain(glm::vec3(0.5f));
  // An L of two quads: floor of `material` that looks up, wall of `dark` that looks along +z.
  scene::Scene scene = make_quad_scene({{{0, 0, 4}, {4, 0, 0}, {0, 0, -4}, 0}, {{0, 1, 0}, {4, 0, 0}, {0, 3, 0}, 1}},
                                       {material, dark}, look_at({2, 2, 9}, {2, 2, 0}, 0.8f));
  const Images images = voxelize(scene, 18);  // voxels of 1/4 m
  const glm::ivec3 on_floor(8, 1, 8);
  ASSERT_TRUE(occupied(images.at("v.voxels.albedo"), on_floor));
  EXPECT_EQ(byte_at(images.at("v.voxels.albedo"), on_floor, 0), 128);
  EXPECT_EQ(byte_at(images.at("v.voxels.albedo"), on_floor, 1), 180);
  EXPECT_EQ(byte_at(images.at("v.voxels.albedo"), on_floor, 2), 255);
  EXPECT_EQ(byte_at(images.at("v.voxels.normal"), on_floor, 1), 0);    // straight up
  EXPECT_EQ(byte_at(images.at("v.voxels.normal"), on_floor, 3), 128);  // metallic
  EXPECT_EQ(byte_at(images.at("v.voxels.material"), on_floor, 0), 128);
  EXPECT_EQ(byte_at(images.at("v.voxels.material"), on_floor, 1), 128);
  EXPECT_EQ(byte_at(images.at("v.voxels.material"), on_floor, 2), 20);  // 4 * 0.5 * 0.04 * 255
  EXPECT_GT(byte_at(images.at("v.voxels.material"), on_floor, 3), 0);
  const glm::ivec3 on_wall(8, 10, 1);
  ASSERT_TRUE(occupied(images.at("v.voxels.albedo"), on_wall));
  EXPECT_EQ(byte_at(images.at("v.voxels.normal"), on_wall, 0), 0);
  EXPECT_EQ(byte_at(images.at("v.voxels.normal"), on_wall, 1), 127);
  EXPECT_EQ(byte_at(images.at("v.voxels.material"), on_wall, 3), 0);
}

/// A floor of 4 m with an image on it; u along +x, v along -z.
scene::Scene textured_floor(const scene::Image& image, scene::AlphaMode alpha_mode) {
  scene::Material material = plain(glm::vec3(1));
  material.base_color_texture.image = 0;
  material.base_color_texture.nearest = true;
  material.alpha_mode = alpha_mode;
  scene::Scene scene = make_quad_scene({{{0, 0, 4}, {4, 0, 0}, {0, 0, -4}, 0}}, {material},
                                       look_at({2, 5, 2}, {2, 0, 2}, 0.8f, {0, 0, -1}));
  scene.images = {image};
  scene.features.textured = true;
  scene.features.alpha = alpha_mode == scene::AlphaMode::mask;
  return scene;
}

TEST_F(VoxelizeTest, TexturesAreTakenWhereTheyLie) {
  const scene::Image quarters = make_image(64, 64, [](uint32_t x, uint32_t y) {
    return std::array<uint8_t, 4>{uint8_t(x < 32 ? 255 : 0), uint8_t(y < 32 ? 255 : 0), 0, 255};
  });
  const Images images = voxelize(textured_floor(quarters, scene::AlphaMode::opaque), 34);  // 8 voxels a metre
  const image::HostImage& albedo = images.at("v.voxels.albedo");
  for (const int x : {4, 12, 21, 29}) {
    for (const int z : {4, 12, 21, 29}) {
      ASSERT_TRUE(occupied(albedo, {x, 1, z}));
      EXPECT_EQ(byte_at(albedo, {x, 1, z}, 0), x < 17 ? 255 : 0);
      EXPECT_EQ(byte_at(albedo, {x, 1, z}, 1), z > 17 ? 255 : 0);  // v = 0, the image's first row, is at z = 4
    }
  }
}

TEST_F(VoxelizeTest, CutOutTexelsClaimNothing) {
  const scene::Image half = make_image(64, 64, [](uint32_t x, uint32_t) {
    return std::array<uint8_t, 4>{255, 255, 255, uint8_t(x < 32 ? 255 : 0)};
  });
  for (const scene::AlphaMode mode : {scene::AlphaMode::opaque, scene::AlphaMode::mask}) {
    const Images images = voxelize(textured_floor(half, mode), 34);
    const image::HostImage& albedo = images.at("v.voxels.albedo");
    for (int x = 2; x < 32; ++x) {
      if (std::abs(x - 17) <= 2) continue;  // the texture's filter blurs its border
      EXPECT_EQ(occupied(albedo, {x, 1, 9}), mode == scene::AlphaMode::opaque || x < 17) << x;
    }
  }
}

TEST_F(VoxelizeTest, StaticAndDynamicTrianglesAreToldApart) {
  // Two triangles far from each other; the second one moves.
  scene::Scene scene = make_triangle_scene({{glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)},
                                            {glm::vec3(3, 3, 3), glm::vec3(4, 3, 3), glm::vec3(3, 4, 3)}},
                                           {plain(glm::vec3(1)), plain(glm::vec3(0.25f))});
  scene.static_vertex_count = 3;
  scene.static_triangle_count = 1;
  scene.features.dynamic = true;
  const Images fixed = voxelize(scene, 20, "static");
  const Images moving = voxelize(scene, 20, "dynamic");
  const Images all = voxelize(scene, 20, "all");
  size_t fixed_count = 0;
  size_t moving_count = 0;
  for_each_voxel(all.at("v.voxels.albedo"), [&](const glm::ivec3& voxel) {
    const bool is_fixed = occupied(fixed.at("v.voxels.albedo"), voxel);
    const bool is_moving = occupied(moving.at("v.voxels.albedo"), voxel);
    fixed_count += is_fixed ? 1 : 0;
    moving_count += is_moving ? 1 : 0;
    ASSERT_EQ(occupied(all.at("v.voxels.albedo"), voxel), is_fixed || is_moving);
    ASSERT_EQ(byte_at(all.at("v.voxels.albedo"), voxel, 0), is_fixed ? 255 : is_moving ? 128 : 0);
  });
  EXPECT_GT(fixed_count, 8u);
  EXPECT_GT(moving_count, 8u);
}

TEST_F(VoxelizeTest, NoDynamicTrianglesGiveAnEmptyGrid) {
  const scene::Scene scene = make_triangle_scene(random_triangles(20, 2.0f, 8), {plain(glm::vec3(1))});
  const Images images = voxelize(scene, 16, "dynamic");
  for (const char* part : {"v.voxels.albedo", "v.voxels.normal", "v.voxels.material"}) {
    const std::vector<std::byte>& texels = images.at(part).texels;
    EXPECT_TRUE(std::all_of(texels.begin(), texels.end(), [](std::byte b) { return b == std::byte{0}; })) << part;
  }
}

}  // namespace
}  // namespace lightloom::test
