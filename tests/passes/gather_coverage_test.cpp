// Which triangle each pixel of the G-buffer shows where rasterisers go wrong: slivers, what crosses the near plane, a
// view of one pixel, surfaces of equal depth. The oracle sends rays through the pixels in double precision.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "tests/passes/gather_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

using GatherCoverage = DeviceTest;

/// Triangles before a camera at (0, 0, eye) that looks along -z.
struct View {
  std::vector<WorldTriangle> triangles;
  float eye = 3;    ///< [m]
  double near = 0;  ///< least depth that is seen [m]
};

struct Hit {
  size_t triangle = 0;
  glm::dvec3 position{0};
  double depth = 0;
  bool operator==(const Hit& other) const { return triangle == other.triangle; }
};

bool inside(const WorldTriangle& triangle, const glm::dvec3& normal, const glm::dvec3& point) {
  for (size_t k = 0; k < 3; ++k) {
    const glm::dvec3 from(triangle[k]), to(triangle[(k + 1) % 3]);
    if (glm::dot(glm::cross(to - from, point - from), normal) < 0) return false;
  }
  return true;
}

/// What the ray through a point of the view meets first [pixels, y down].
std::optional<Hit> first_hit(const View& view, double x, double y) {
  const glm::dvec3 eye(0, 0, view.eye);
  const glm::dvec3 ray = front_ray(x, y);
  std::optional<Hit> first;
  for (size_t i = 0; i < view.triangles.size(); ++i) {
    const WorldTriangle& t = view.triangles[i];
    const glm::dvec3 a(t[0]);
    const glm::dvec3 normal = glm::cross(glm::dvec3(t[1]) - a, glm::dvec3(t[2]) - a);
    const double depth = glm::dot(a - eye, normal) / glm::dot(ray, normal);
    const bool seen = depth > view.near && (!first || depth < first->depth);
    if (seen && inside(t, normal, eye + depth * ray)) first = Hit{i, eye + depth * ray, depth};
  }
  return first;
}

/// Rasterisers snap corners to parts of a pixel, so a pixel counts if all rays so near its centre meet the same
/// [pixels].
constexpr double kSnap = 0.02;

bool is_certain(const View& view, int x, int y) {
  const std::optional<Hit> centre = first_hit(view, x + 0.5, y + 0.5);
  for (const double side_x : {-kSnap, kSnap})
    for (const double side_y : {-kSnap, kSnap})
      if (first_hit(view, x + 0.5 + side_x, y + 0.5 + side_y) != centre) return false;
  return true;
}

/// Pixels by what they show: how many there are of each triangle, then of none, then of those that do not count.
std::vector<int> expect_first_hits(const View& view, double tolerance) {
  scene::Material material = plain(glm::vec3(1));
  material.double_sided = true;
  scene::Scene scene = make_triangle_scene(view.triangles, {material});
  scene.cameras = {look_at({0, 0, view.eye}, {0, 0, view.eye - 1}, kFieldOfView)};
  const Images images = gather(scene);
  std::vector<int> counts(view.triangles.size() + 2);
  for (int y = 0; y < kViewHeight; ++y) {
    for (int x = 0; x < kViewWidth; ++x) {
      if (!is_certain(view, x, y)) {
        ++counts.back();
        continue;
      }
      const std::optional<Hit> hit = first_hit(view, x + 0.5, y + 0.5);
      const double shown = images.at("g.visibility").at(static_cast<uint32_t>(x), static_cast<uint32_t>(y), 0, 0);
      EXPECT_EQ(shown, hit ? static_cast<double>(hit->triangle + 1) : 0) << x << ' ' << y;
      const glm::dvec4 expected = hit ? glm::dvec4(hit->position, hit->depth) : glm::dvec4(0);
      EXPECT_LT(glm::distance(texel(images, "position", x, y), expected), tolerance) << x << ' ' << y;
      ++counts[hit ? hit->triangle : view.triangles.size()];
    }
  }
  return counts;
}

/// Two triangles that fill the view behind all else, facing the camera.
void add_backdrop(std::vector<WorldTriangle>& triangles, float z, float half) {
  triangles.push_back({glm::vec3(-half, -half, z), {half, -half, z}, {half, half, z}});
  triangles.push_back({glm::vec3(-half, -half, z), {half, half, z}, {-half, half, z}});
}

/// Height of a pixel at depth 1 [m].
double pixel_height() {
  return front_ray(0, 0).y - front_ray(0, 1).y;
}

TEST_F(GatherCoverage, ASliverIsSeenInThePixelsWhoseCentreItCovers) {
  const auto width = static_cast<float>(0.3 * 3 * pixel_height());
  View across{{{glm::vec3(-1.6f, -1.1f, 0), {1.6f, 1.1f - width, 0}, {1.6f, 1.1f + width, 0}}}};
  const std::vector<int> alone = expect_first_hits(across, 1e-4);
  EXPECT_GT(alone[0], 10);
  EXPECT_GT(alone[1], 2500);
  add_backdrop(across.triangles, -2, 8);
  EXPECT_EQ(expect_first_hits(across, 1e-4)[0], alone[0]);

  // From a tenth of a metre before the camera to fifty behind.
  View along{{{glm::vec3(0.03f, -0.03f, 2.9f), {-9, 11, -50}, {-9.1f, 12, -50}}}};
  EXPECT_GT(expect_first_hits(along, 1e-2)[0], 5);
}

TEST_F(GatherCoverage, SliversOfAllDirections) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> unit(0, 1);
  View view;
  for (int i = 0; i < 60; ++i) {
    const float z = 0.03f * static_cast<float>(i);  // none meets another
    const auto pixel = static_cast<float>((3 - z) * pixel_height());
    const glm::vec2 from(3 * unit(random) - 1.5f, 2 * unit(random) - 1);
    const float angle = 6.3f * unit(random);
    const glm::vec2 along(std::cos(angle), std::sin(angle));
    const glm::vec2 to = from + 1.5f * along;
    const glm::vec2 aside = glm::vec2(-along.y, along.x) * (0.05f + unit(random)) * pixel;
    view.triangles.push_back({glm::vec3(from, z), glm::vec3(to, z), glm::vec3(to + aside, z)});
  }
  add_backdrop(view.triangles, -1, 8);
  const std::vector<int> counts = expect_first_hits(view, 1e-4);
  int slivers = 0;
  for (size_t i = 0; i < 60; ++i) slivers += counts[i];
  EXPECT_GT(slivers, 100);
  EXPECT_LT(counts.back(), 400);
}

TEST_F(GatherCoverage, OfWhatReachesBehindTheCameraTheFrontPartIsSeen) {
  View floor{{{glm::vec3(-6, -1, -9), {6, -1, -9}, {0.5f, -1, 11}}}};  // one corner behind
  EXPECT_GT(expect_first_hits(floor, 1e-4)[0], 500);
  add_backdrop(floor.triangles, -10, 12);
  EXPECT_GT(expect_first_hits(floor, 1e-3)[0], 500);
  View wall{{{glm::vec3(-0.3f, -1.2f, -3), {0.9f, 0.8f, 9}, {-5, 0.5f, 8}}}};  // two behind
  const std::vector<int> counts = expect_first_hits(wall, 1e-4);
  EXPECT_GT(counts[0], 200);
  EXPECT_GT(counts[1], 200);
}

TEST_F(GatherCoverage, WhatIsNearerThanTheNearPlaneIsNotSeen) {
  // The far plane lies 1.01 times as far as the scene reaches, the near plane at 1e-4 of that: 2 mm. The floor is half
  // a millimetre below the eye and ends at the near plane, in the middle of the lower half of the view.
  View view{{{glm::vec3(-9, -5e-4f, -20), {9, -5e-4f, -20}, {0, -5e-4f, 20}}}, 0, 20 * 1.01 * 1e-4};
  add_backdrop(view.triangles, -20, 20);
  const std::vector<int> counts = expect_first_hits(view, 1e-3);
  EXPECT_GT(counts[0], 800);
  EXPECT_GT(counts[1] + counts[2], 2000);
  const std::optional<Hit> bottom = first_hit(view, 32.5, 47.5);
  ASSERT_TRUE(bottom.has_value());
  EXPECT_GT(bottom->depth, 19) << "the floor is cut off there";
}

TEST_F(GatherCoverage, AViewOfOnePixelSeesWhatIsAhead) {
  scene::Material material = plain(glm::vec3(1));
  material.base_color_texture.image = 0;
  const QuadSpec slanted = {{-8, -8, -4}, {16, 0, 8}, {0, 16, 0}, 0};
  scene::Scene scene = make_quad_scene({slanted}, {material}, look_at({1, 2, 5}, {1, 2, 0}, kFieldOfView));
  scene.images = {make_image(64, 64, [](uint32_t x, uint32_t y) {
    const auto value = uint8_t((x + y) % 2 * 255);
    return std::array<uint8_t, 4>{value, value, value, 255};
  })};
  scene.features.textured = true;
  GraphRunOptions options;
  options.capture = {"*"};
  const std::string graph = graph_text(1, 1, 1, 1, R"("g": { "type": "gather" })", R"("m": "g.motion")");
  const Images images = run_graph(graph, scene, options).front();
  EXPECT_EQ(images.at("g.visibility").at(0, 0, 0, 0), 2) << "the half above the diagonal";
  EXPECT_EQ(texel(images, "id", 0, 0), glm::dvec4(1, 0, 0, 0));
  EXPECT_LT(glm::distance(texel(images, "position", 0, 0), glm::dvec4(1, 2, 0.5, 4.5)), 1e-5);
  EXPECT_LT(glm::distance(direction(images, "normal", 0, 0), glm::normalize(glm::dvec3(-0.5, 0, 1))), 1e-3);
  EXPECT_NEAR(texel(images, "albedo", 0, 0)[kX], 0.5, 0.01) << "seventeen texels high";
  EXPECT_EQ(images.at("m").at(0, 0, 0, 0), 0);
  EXPECT_EQ(images.at("m").at(0, 0, 0, 1), 0);

  scene.cameras = {look_at({1, 2, 5}, {1, 2, 9}, kFieldOfView)};
  const Images away = run_graph(graph, scene, options).front();
  EXPECT_EQ(away.at("g.visibility").at(0, 0, 0, 0), 0);
  for (const char* part : {"position", "normal", "tangent", "albedo", "material", "emission", "id"})
    EXPECT_EQ(texel(away, part, 0, 0), glm::dvec4(0)) << part;
}

/// Slanted quads in one and the same place, each of the material `of` it. Material 0 and 1 are opaque; 2 and 3 have
/// holes in the left half of the view.
scene::Scene quads_in_one_place(const std::vector<uint32_t>& of) {
  std::vector<scene::Material> materials(4, plain(glm::vec3(1)));
  for (const size_t masked : {2, 3}) {
    materials[masked].alpha_mode = scene::AlphaMode::mask;
    materials[masked].base_color_texture.image = 0;
  }
  std::vector<QuadSpec> quads;
  for (const uint32_t material : of) quads.push_back({{-4, -4, -2}, {8, 0, 4}, {0, 8, 0}, material});
  scene::Scene scene = make_quad_scene(quads, materials, front_camera(3));
  scene.images = {make_image(64, 64, [](uint32_t x, uint32_t) {
    return std::array<uint8_t, 4>{255, 255, 255, uint8_t(x < 32 ? 0 : 255)};
  })};
  scene.features.textured = true;
  scene.features.alpha = true;
  return scene;
}

TEST_F(GatherCoverage, AtEqualDepthTheMaskIsSeenAndElseTheLaterTriangle) {
  struct Case {
    std::vector<uint32_t> materials;  ///< of the quads, in their order
    uint32_t left, right;             ///< material that is seen
  };
  const std::vector<Case> cases = {{{0, 1}, 1, 1},    {{1, 0}, 0, 0},    {{0, 2}, 0, 2},       {{2, 0}, 0, 2},
                                   {{0, 2, 3}, 0, 3}, {{3, 0, 2}, 0, 2}, {{1, 3, 0, 2}, 0, 2}, {{2, 3, 0, 1}, 1, 3}};
  for (const Case& c : cases) {
    const scene::Scene scene = quads_in_one_place(c.materials);
    const Images images = gather(scene);
    for (int y = 0; y < kViewHeight; ++y) {
      for (int x = 0; x < kViewWidth; ++x) {
        if (std::abs(x + 0.5 - kViewWidth / 2.0) < 2) continue;  // where the texture is filtered
        ASSERT_EQ(texel(images, "id", x, y)[kY], x < kViewWidth / 2 ? c.left : c.right)
            << ::testing::PrintToString(c.materials) << ' ' << x << ' ' << y;
      }
    }
    const Images again = gather(scene);
    for (const auto& [name, image] : images) EXPECT_TRUE(image.texels == again.at(name).texels) << name;
  }
}

}  // namespace
}  // namespace lightloom::test
