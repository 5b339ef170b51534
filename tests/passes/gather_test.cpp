#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/passes/gather_support.hpp"
#include "tests/passes/voxel_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

using GatherTest = DeviceTest;

void expect_direction(const glm::dvec3& got, const glm::dvec3& expected) {
  EXPECT_LT(glm::distance(got, expected), 2e-3) << got.x << ' ' << got.y << ' ' << got.z;
}

TEST_F(GatherTest, PositionsNormalsAndDepthsOfASlantedPlaneAreAnalytic) {
  constexpr double kSlope = 0.5;
  const QuadSpec quad = {{-8, -8, -4}, {16, 0, 8}, {0, 16, 0}, 0};
  const scene::Scene scene = make_quad_scene({quad}, {plain({0.25f, 0.5f, 0.75f})}, front_camera(5));
  const Images images = gather(scene);
  const glm::dvec3 normal = glm::normalize(glm::dvec3(-kSlope, 0, 1));
  for (int y = 0; y < kViewHeight; ++y) {
    for (int x = 0; x < kViewWidth; ++x) {
      const glm::dvec3 expected = on_plane(x, y, 5, kSlope);
      const glm::dvec4 position = texel(images, "position", x, y);
      ASSERT_LT(glm::distance(glm::dvec3(position), expected), 1e-4) << x << ' ' << y;
      ASSERT_NEAR(position.w, 5 - expected.z, 1e-4);
      expect_direction(direction(images, "normal", x, y), normal);
      expect_direction(direction(images, "geometric_normal", x, y), normal);
      expect_direction(direction(images, "tangent", x, y), glm::normalize(glm::dvec3(1, 0, kSlope)));
      ASSERT_EQ(texel(images, "id", x, y), glm::dvec4(1, 0, 0, 0));
    }
  }
  EXPECT_EQ(texel(images, "albedo", 9, 9), glm::dvec4(0.25, 0.5, 0.75, 0));
}

TEST_F(GatherTest, MaterialsBecomeWardLobes) {
  scene::Material material;
  material.base_color = {0.5f, 0.5f, 0.5f, 1};
  material.metallic = 0.25f;
  material.roughness = 0.5f;
  material.specular_factor = 0.5f;
  material.specular_color = glm::vec3(0.5f);
  material.ior = 2;  // F0 = (1/3)^2
  material.emission = {2, 3, 1e8f};
  material.anisotropy_strength = 0.5f;
  material.anisotropy_rotation = std::numbers::pi_v<float> / 2;
  const scene::Scene scene = make_quad_scene({facing_quad(0, 4, 4)}, {material}, front_camera(3));
  const Images images = gather(scene);
  const glm::dvec4 lobe = texel(images, "material", 20, 20);
  EXPECT_NEAR(lobe[kX], 0.25 + 0.75 * 0.25, 1e-3);
  EXPECT_NEAR(lobe[kY], 0.25, 1e-3);
  EXPECT_NEAR(lobe[kZ], 0.5 * 0.5 / 9, 1e-4);
  EXPECT_NEAR(lobe[kW], 0.5, 1e-3);
  EXPECT_NEAR(texel(images, "albedo", 20, 20)[kW], 0.25, 1e-3);
  EXPECT_EQ(texel(images, "emission", 20, 20), glm::dvec4(2, 3, 1e8f, 0));
  expect_direction(direction(images, "tangent", 20, 20), {0, 1, 0});
  EXPECT_EQ(texel(images, "tangent", 20, 20)[kW], 1);
}

TEST_F(GatherTest, SmoothMaterialsKeepALobe) {
  scene::Material mirror;
  mirror.roughness = 0;
  const scene::Scene scene = make_quad_scene({facing_quad(0, 4, 4)}, {mirror}, front_camera(3));
  const glm::dvec4 lobe = texel(gather(scene), "material", 20, 20);
  EXPECT_NEAR(lobe[kX], 1e-3, 1e-5);
  EXPECT_NEAR(lobe[kY], 1e-3, 1e-5);
}

TEST_F(GatherTest, TheNearerSurfaceIsSeenWhateverTheOrder) {
  const std::vector<scene::Material> materials = {plain({1, 0, 0}), plain({0, 1, 0})};
  const QuadSpec near = facing_quad(1, 0.4f, 0.4f, 0);
  const QuadSpec far = facing_quad(0, 1, 0.7f, 1);
  for (const auto& quads : {std::vector<QuadSpec>{near, far}, std::vector<QuadSpec>{far, near}}) {
    const Images images = gather(make_quad_scene(quads, materials, front_camera(3)));
    for (int y = 0; y < kViewHeight; ++y) {
      for (int x = 0; x < kViewWidth; ++x) {
        const glm::dvec3 at_near = on_plane(x, y, 2, 0);
        const glm::dvec3 at_far = on_plane(x, y, 3, 0);
        const bool sees_near = std::max(std::abs(at_near.x), std::abs(at_near.y)) < 0.4;
        const bool sees_far = std::abs(at_far.x) < 1 && std::abs(at_far.y) < 0.7f;
        const glm::dvec4 expected = sees_near  ? glm::dvec4(1, 0, 0, 0)
                                    : sees_far ? glm::dvec4(0, 1, 0, 0)
                                               : glm::dvec4(0);
        ASSERT_EQ(texel(images, "albedo", x, y), expected) << x << ' ' << y;
        ASSERT_EQ(texel(images, "id", x, y)[kX] == 0, !sees_near && !sees_far);
        if (!sees_near && !sees_far) {
          ASSERT_EQ(texel(images, "position", x, y), glm::dvec4(0));
        }
      }
    }
  }
}

TEST_F(GatherTest, ABackIsUnseenUnlessDoubleSidedAndThenTurned) {
  const QuadSpec away = {{1, -1, 0}, {-2, 0, 0}, {0, 2, 0}, 0};  // its front looks along -z
  scene::Material material = plain(glm::vec3(1));
  EXPECT_EQ(texel(gather(make_quad_scene({away}, {material}, front_camera(2))), "id", 32, 24)[kX], 0);
  material.double_sided = true;
  const Images images = gather(make_quad_scene({away}, {material}, front_camera(2)));
  EXPECT_EQ(texel(images, "id", 32, 24)[kX], 1);
  expect_direction(direction(images, "normal", 32, 24), {0, 0, 1});
  expect_direction(direction(images, "geometric_normal", 32, 24), {0, 0, 1});
  EXPECT_EQ(texel(images, "geometric_normal", 32, 24)[kW], 1);
  // The tangent stays, so the bitangent's sign turns with the normal.
  expect_direction(direction(images, "tangent", 32, 24), {-1, 0, 0});
  EXPECT_EQ(texel(images, "tangent", 32, 24)[kW], -1);
}

TEST_F(GatherTest, VertexColoursMultiplyTheBaseColour) {
  scene::Scene scene = make_quad_scene({facing_quad(0, 4, 4)}, {plain({1, 0.5f, 1})}, front_camera(3));
  for (scene::Vertex& vertex : scene.vertices) vertex.color = 0xFF0080FFu;  // red 255, green 128, blue 0
  const glm::dvec4 albedo = texel(gather(scene), "albedo", 20, 20);
  EXPECT_NEAR(albedo[kX], 1, 1e-3);
  EXPECT_NEAR(albedo[kY], 0.5 * 128 / 255, 1e-3);
  EXPECT_NEAR(albedo[kZ], 0, 1e-3);
}

TEST_F(GatherTest, NormalMapsTiltTheNormalAndTheTangentFollows) {
  scene::Material material = plain(glm::vec3(1));
  material.normal_texture.image = 0;
  scene::Scene scene = make_quad_scene({facing_quad(0, 4, 4)}, {material}, front_camera(3));
  // (0.6, 0, 0.8) as x * 2 - 1 in 8 bits.
  scene.images = {make_image(
      4, 4,
      [](uint32_t, uint32_t) {
        return std::array<uint8_t, 4>{204, 128, 230, 255};
      },
      false)};
  scene.features.textured = true;
  scene.features.normal_mapped = true;
  const Images images = gather(scene);
  const glm::dvec3 expected = glm::normalize(glm::dvec3(204, 128, 230) * (2 / 255.0) - 1.0);
  const glm::dvec3 normal = direction(images, "normal", 30, 20);
  const glm::dvec3 tangent = direction(images, "tangent", 30, 20);
  EXPECT_LT(glm::distance(normal, expected), 5e-3);
  EXPECT_NEAR(glm::dot(normal, tangent), 0, 2e-3);
  EXPECT_NEAR(glm::length(tangent), 1, 2e-3);
  EXPECT_GT(tangent.x, 0.7);
  expect_direction(direction(images, "geometric_normal", 30, 20), {0, 0, 1});
}

TEST_F(GatherTest, TheIdNamesTheTriangleAndThePlaceOnIt) {
  const std::vector<WorldTriangle> triangles = {WorldTriangle{{{-2, -2, 0.5f}, {2, -2, -0.5f}, {-2, 2, 0}}},
                                                WorldTriangle{{{2, -2, -0.5f}, {2, 2, 1}, {-2, 2, 0}}}};
  const scene::Scene scene = [&] {
    scene::Scene made = make_triangle_scene(triangles, {plain(glm::vec3(1)), plain(glm::vec3(0.5f))});
    made.cameras = {front_camera(3)};
    return made;
  }();
  const Images images = gather(scene);
  const image::HostImage& ids = images.at("g.surface.id");
  std::array<int, 2> seen{};
  for (uint32_t y = 0; y < kViewHeight; ++y) {
    for (uint32_t x = 0; x < kViewWidth; ++x) {
      if (ids.at(x, y, 0, kX) == 0) continue;
      const auto index = static_cast<size_t>(ids.at(x, y, 0, kZ));
      ASSERT_LT(index, triangles.size());
      ASSERT_EQ(ids.at(x, y, 0, kY), static_cast<double>(index)) << "material of the same triangle";
      ++seen[index];
      const auto packed = static_cast<uint32_t>(ids.at(x, y, 0, kW));
      const double b = (packed & 0xFFFFu) / 65535.0, c = (packed >> 16) / 65535.0;
      const auto corner = [&](size_t k) { return glm::dvec3(triangles[index][k]); };
      const glm::dvec3 place = (1 - b - c) * corner(0) + b * corner(1) + c * corner(2);
      ASSERT_LT(glm::distance(place, direction(images, "position", static_cast<int>(x), static_cast<int>(y))), 2e-4);
    }
  }
  EXPECT_GT(seen[0], 200);
  EXPECT_GT(seen[1], 200);
}

TEST_F(GatherTest, AnOrthographicCameraSeesParallelRays) {
  scene::Camera camera = front_camera(5);
  camera.perspective = false;
  camera.half_height = 2;
  const QuadSpec quad = {{-8, -8, -4}, {16, 0, 8}, {0, 16, 0}, 0};
  const Images images = gather(make_quad_scene({quad}, {plain(glm::vec3(1))}, camera));
  const double depth_of_left = texel(images, "position", 0, 0)[kW];
  for (int x = 0; x < kViewWidth; ++x) {
    const double expected_x = (2 * (x + 0.5) / kViewWidth - 1) * 2 * kViewWidth / kViewHeight;
    const glm::dvec4 position = texel(images, "position", x, 7);
    EXPECT_NEAR(position[kX], expected_x, 1e-4);
    EXPECT_NEAR(position[kZ], 0.5 * expected_x, 1e-3);
    EXPECT_NEAR(position[kW] - depth_of_left, 0.5 * (texel(images, "position", 0, 7)[kX] - expected_x), 1e-2);
    EXPECT_GT(position[kW], 0);
  }
}

}  // namespace
}  // namespace lightloom::test
