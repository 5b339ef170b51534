// The exact tracing of voxels: rays against every box of a grid, and rooms of emissive voxels in closed form.
#include "framework/reference/voxel_geometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "framework/base/error.hpp"
#include "framework/reference/environment_light.hpp"
#include "framework/reference/lights.hpp"
#include "framework/reference/path_tracer.hpp"

namespace lightloom::test {
namespace {

using reference::VoxelGrid;

/// Owns what the images show. The bounds make voxels of edge `size` with the low corner of the grid at `low`.
struct Grid {
  glm::ivec3 extent;
  std::vector<uint8_t> albedo, normal, material;
  scene::Bounds bounds;

  explicit Grid(const glm::ivec3& voxels, const glm::vec3& low = glm::vec3(0), float size = 1) : extent(voxels) {
    const size_t count = size_t{4} * voxels.x * voxels.y * voxels.z;
    albedo.resize(count);
    normal.resize(count);
    material.resize(count);
    bounds = {low + size, low + size * glm::vec3(voxels - 1)};
  }

  void fill(const glm::ivec3& voxel, uint8_t root_albedo, uint8_t polar, uint8_t azimuth, uint8_t emission) {
    const size_t at = 4 * ((static_cast<size_t>(voxel.z) * extent.y + voxel.y) * extent.x + voxel.x);
    for (size_t channel = 0; channel < 3; ++channel) albedo[at + channel] = root_albedo;
    albedo[at + 3] = 255;
    normal[at] = azimuth;
    normal[at + 1] = polar;
    normal[at + 2] = 63;
    material[at] = material[at + 1] = 255;
    material[at + 3] = emission;
  }

  [[nodiscard]] reference::VoxelImages images() const {
    return {.extent = extent, .albedo = albedo, .normal = normal, .material = material};
  }
};

/// Where the ray enters a unit box, by the three pairs of its planes; infinity if it misses.
double entry(const glm::dvec3& low, const glm::dvec3& origin, const glm::dvec3& direction) {
  double near = 0, far = INFINITY;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (low[axis] - origin[axis]) / direction[axis], b = (low[axis] + 1 - origin[axis]) / direction[axis];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return near <= far ? near : INFINITY;
}

TEST(VoxelGeometry, ARayMeetsTheFirstOfAllBoxesThatItTouches) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-4, 13), unit(-1, 1);
  Grid grid({9, 7, 8});
  std::vector<glm::ivec3> filled;
  for (int i = 0; i < 25; ++i) {
    const glm::ivec3 voxel(random() % 9, random() % 7, random() % 8);
    grid.fill(voxel, 128, 0, 0, 0);
    filled.push_back(voxel);
  }
  const VoxelGrid voxels(grid.images(), grid.bounds);
  int hits = 0;
  for (int ray = 0; ray < 20000; ++ray) {
    const glm::dvec3 origin(place(random), place(random), place(random));
    const glm::dvec3 direction = glm::normalize(glm::dvec3(unit(random), unit(random), unit(random)));
    double nearest = INFINITY;
    for (const glm::ivec3& voxel : filled) nearest = std::min(nearest, entry(glm::dvec3(voxel), origin, direction));
    const auto hit = voxels.first_hit(origin, direction);
    ASSERT_EQ(hit.has_value(), std::isfinite(nearest)) << ray;
    if (!hit) continue;
    ++hits;
    ASSERT_NEAR(hit->t, nearest, 1e-9);
    EXPECT_TRUE(voxels.occupied(hit->voxel));
    EXPECT_FALSE(voxels.first_hit(origin, direction, nearest - 1e-6).has_value());
    if (hit->axis >= 0) {
      const double plane = hit->voxel[hit->axis] + (hit->side > 0 ? 1 : 0);
      EXPECT_NEAR(origin[hit->axis] + direction[hit->axis] * hit->t, plane, 1e-9);
      EXPECT_LT(direction[hit->axis] * hit->side, 0);
    }
  }
  EXPECT_GT(hits, 1000);
}

TEST(VoxelGeometry, RaysAlongTheGridMeetWhatLiesOnThem) {
  Grid grid({5, 5, 5});
  grid.fill({3, 2, 1}, 128, 0, 0, 0);
  const VoxelGrid voxels(grid.images(), grid.bounds);
  EXPECT_NEAR(voxels.first_hit({-2, 2.5, 1.5}, {1, 0, 0})->t, 5, 1e-12);
  EXPECT_NEAR(voxels.first_hit({3.5, 9, 1}, {0, -1, 0})->t, 6, 1e-12);
  EXPECT_FALSE(voxels.first_hit({3.5, 9, 2.5}, {0, -1, 0}).has_value());
  EXPECT_FALSE(voxels.first_hit({3.5, 9, -1}, {0, -1, 0}).has_value());
  EXPECT_EQ(voxels.first_hit({3.5, 2.5, 1.5}, {0, -1, 0})->axis, -1) << "it starts in an occupied voxel";
}

TEST(VoxelGeometry, PlacesAndBytesAreWhatTheyStandFor) {
  Grid grid({6, 4, 5}, {-2, 1, 3}, 0.25f);
  grid.fill({1, 1, 1}, 128, 127, 64, 7);
  grid.normal[4 * ((1 * 4 + 1) * 6 + 1) + 3] = 51;
  const VoxelGrid voxels(grid.images(), grid.bounds);
  EXPECT_NEAR(voxels.voxel_size(), 0.25, 1e-9);
  EXPECT_NEAR(glm::distance(voxels.to_grid({-2, 1, 3}), glm::dvec3(0)), 0, 1e-9);
  EXPECT_NEAR(glm::distance(voxels.to_world({6, 4, 5}), glm::vec3(-0.5f, 2, 4.25f)), 0, 1e-6);
  const reference::Voxel voxel = voxels.decode({1, 1, 1});
  EXPECT_NEAR(glm::distance(voxel.normal, glm::vec3(1, 0, 0)), 0, 1e-6) << "a quarter turn from z towards x";
  EXPECT_NEAR(glm::distance(voxel.tangent, glm::vec3(0, 0, -1)), 0, 1e-6) << "along growing azimuth";
  EXPECT_FLOAT_EQ(voxel.reflectance.base_color.g, 128.0f * 128 / 255 / 255);
  EXPECT_FLOAT_EQ(voxel.reflectance.metallic, 0.2f);
  EXPECT_EQ(voxel.emission, 7U);
  grid.albedo.pop_back();
  EXPECT_THROW(VoxelGrid(grid.images(), grid.bounds), Error);
}

/// A closed box of voxels one deep, each with the normal of its wall, which emits and reflects.
Grid room(int side, uint8_t root_albedo) {
  Grid grid({side, side, side}, glm::vec3(-1.5f), 3.0f / static_cast<float>(side));
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const auto on = [&](int at) { return at == 0 || at == side - 1; };
        if (!on(x) && !on(y) && !on(z)) continue;
        const int polar = on(y) ? (y == 0 ? 0 : 254) : 127;
        const int azimuth = on(x) ? (x == 0 ? 64 : 192) : (z == 0 ? 0 : 128);
        grid.fill({x, y, z}, root_albedo, static_cast<uint8_t>(polar), static_cast<uint8_t>(azimuth), 1);
      }
  return grid;
}

TEST(VoxelGeometry, AnEmissiveRoomSumsTheSeriesOfItsBounces) {
  constexpr double kEmission = 2;
  const scene::Environment black;
  const reference::EnvironmentLight environment(black);
  const reference::Lights lights{reference::SunLight(std::nullopt, reference::SunModel::disc), &environment,
                                 reference::PunctualLights({})};
  for (const uint8_t root : {uint8_t{180}, uint8_t{228}}) {
    const Grid grid = room(16, root);
    const scene::EmissionEntry none,
        lit{.radiance = glm::vec3(kEmission), .two_sided = true, .threshold = 0, .material = 0};
    const std::array<scene::EmissionEntry, 2> entries{none, lit};
    const reference::VoxelGeometry geometry(grid.images(), grid.bounds, entries);
    const double albedo = std::pow(root / 255.0, 2);
    reference::SurfacePoint wall;
    wall.position = {0.2f, -0.1f, -1.2f};
    wall.geometric_normal = wall.normal = {0, 0, 1};
    wall.tangent = {1, 0, 0};
    wall.reflectance.base_color = glm::vec3(1);
    for (const reference::Strategy strategy :
         {reference::Strategy::mis, reference::Strategy::nee, reference::Strategy::bsdf})
      for (const uint32_t bounces : {0u, 1u, 4u}) {
        const reference::PathSettings settings{.bounces = bounces, .strategy = strategy};
        const reference::PathTracer<reference::VoxelGeometry> tracer(geometry, lights, settings);
        const reference::PathVertex first(geometry.start(wall), {0, 0, 1}, settings.ward);
        double sum = 0, squares = 0;
        constexpr uint32_t kPaths = 30000;
        for (uint32_t path = 0; path < kPaths; ++path) {
          const auto value = static_cast<double>(tracer.reflected(first, {1, 2, 3, 4, path}).sum().g);
          sum += value;
          squares += value * value;
        }
        const double mean = sum / kPaths, error = std::sqrt(std::max(squares / kPaths - mean * mean, 0.0) / kPaths);
        const double expected = kEmission * (1 - std::pow(albedo, bounces + 1)) / (1 - albedo);
        EXPECT_LT(std::abs(mean - expected), 4 * error + 2e-5 * expected)
            << albedo << ", " << bounces << " bounces: " << mean << " +- " << error << ", not " << expected;
      }
  }
}

TEST(VoxelGeometry, OneSidedVoxelsAreDarkFromBehindAndAreasSetTheirPower) {
  Grid grid({8, 8, 8});
  grid.fill({4, 4, 4}, 128, 0, 0, 1);
  const scene::EmissionEntry none, lit{.radiance = glm::vec3(3), .two_sided = false, .threshold = 0, .material = 0};
  const std::array<scene::EmissionEntry, 2> entries{none, lit};
  const auto seen = [&](const reference::VoxelGeometry& geometry, const glm::vec3& from) {
    const reference::Ray ray{from, glm::normalize(glm::vec3(4.5f) - from)};
    const auto hit = geometry.closest_hit(ray);
    EXPECT_TRUE(hit.has_value());
    return geometry.emission({}, ray, *hit).radiance.r;
  };
  const reference::VoxelGeometry plain(grid.images(), grid.bounds, entries);
  EXPECT_EQ(seen(plain, {5, 7.5f, 4.6f}), 3);
  EXPECT_EQ(seen(plain, {5, 0.5f, 4.6f}), 0);
  EXPECT_EQ(seen(plain, {7.5f, 5, 4.6f}), 3) << "from the side, above its plane";
  // The voxel's own power: the top face whole, the four sides half each.
  const std::array<float, 2> half{0, 1.5f}, many{0, 100};
  EXPECT_FLOAT_EQ(seen(reference::VoxelGeometry(grid.images(), grid.bounds, entries, half), {5, 7.5f, 4.6f}), 1.5f);
  EXPECT_FLOAT_EQ(seen(reference::VoxelGeometry(grid.images(), grid.bounds, entries, many), {5, 7.5f, 4.6f}), 12);
}

}  // namespace
}  // namespace lightloom::test
