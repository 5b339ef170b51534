// The Cornell box by a second tracer that shares nothing with the first: every triangle is tried for every ray, in
// double precision; directions are uniform on the hemisphere; lights are met by chance alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <random>
#include <thread>

#include "tests/support/source_dir.hpp"
#include "tests/support/tracing.hpp"

namespace lightloom::test {
namespace {

constexpr uint32_t kColumns = 16, kRows = 12;

/// Moeller and Trumbore 1997.
struct Wall {
  glm::dvec3 a, ab, ac, normal, albedo, emission;

  [[nodiscard]] std::optional<double> distance(const glm::dvec3& origin, const glm::dvec3& direction) const {
    const glm::dvec3 p = glm::cross(direction, ac);
    const double determinant = glm::dot(ab, p);
    if (std::abs(determinant) < 1e-14) return std::nullopt;
    const glm::dvec3 from_a = origin - a;
    const double u = glm::dot(from_a, p) / determinant;
    if (u < 0 || u > 1) return std::nullopt;
    const glm::dvec3 q = glm::cross(from_a, ab);
    const double v = glm::dot(direction, q) / determinant;
    const double t = glm::dot(ac, q) / determinant;
    if (v < 0 || u + v > 1 || t < 1e-9) return std::nullopt;
    return t;
  }
};

std::vector<Wall> walls_of(const scene::Scene& scene) {
  std::vector<Wall> walls;
  for (const scene::Triangle& triangle : scene.triangles) {
    const glm::dvec3 a(scene.vertices[triangle.a].position), b(scene.vertices[triangle.b].position),
        c(scene.vertices[triangle.c].position);
    const scene::Material& material = scene.materials[triangle.material];
    walls.push_back({a, b - a, c - a, glm::normalize(glm::cross(b - a, c - a)),
                     glm::dvec3(glm::vec3(material.base_color)), glm::dvec3(material.emission)});
  }
  return walls;
}

/// Light along a ray: what the walls emit, after 0 to `scatterings` reflections. All of them emit and reflect on both
/// sides.
glm::dvec3 light_along(const std::vector<Wall>& walls, glm::dvec3 origin, glm::dvec3 direction, int scatterings,
                       std::mt19937_64& engine) {
  std::uniform_real_distribution<double> uniform(0, 1);
  glm::dvec3 light(0), share(1);
  for (int bounce = 0;; ++bounce) {
    const Wall* met = nullptr;
    double nearest = 1e300;
    for (const Wall& wall : walls)
      if (const auto t = wall.distance(origin, direction); t && *t < nearest) {
        nearest = *t;
        met = &wall;
      }
    if (met == nullptr) return light;
    light += share * met->emission;
    if (bounce == scatterings) return light;
    const glm::dvec3 normal = glm::dot(met->normal, direction) < 0 ? met->normal : -met->normal;
    origin += direction * nearest;
    do {
      // Uniform on the sphere by a uniform height, turned to the side of the normal.
      const double height = 2 * uniform(engine) - 1, azimuth = 2 * std::numbers::pi * uniform(engine);
      const double radius = std::sqrt(1 - height * height);
      direction = {radius * std::cos(azimuth), radius * std::sin(azimuth), height};
    } while (direction == glm::dvec3(0));
    if (glm::dot(direction, normal) < 0) direction = -direction;
    share *= met->albedo * (2 * glm::dot(direction, normal));
  }
}

struct Cell {
  glm::dvec3 sum{0}, squares{0};
  uint64_t count = 0;
};

/// The image in cells; each row has random numbers of its own.
std::vector<Cell> brute_force(const scene::Scene& scene, uint32_t paths, int scatterings) {
  const std::vector<Wall> walls = walls_of(scene);
  const glm::dmat4 camera(scene.cameras.front().world_from_camera);
  const double slope = std::tan(0.5 * static_cast<double>(scene.cameras.front().vertical_fov));
  std::vector<Cell> cells(kColumns * kRows);
  const auto row = [&](uint32_t y) {
    std::mt19937_64 engine(y + 1);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (uint32_t x = 0; x < kColumns; ++x)
      for (uint32_t path = 0; path < paths; ++path) {
        const double right = 2 * (x + uniform(engine)) / kColumns - 1, up = 1 - 2 * (y + uniform(engine)) / kRows;
        const glm::dvec3 local(right * slope * kColumns / kRows, up * slope, -1);
        const glm::dvec3 direction = glm::normalize(glm::dmat3(camera) * local);
        const glm::dvec3 light = light_along(walls, glm::dvec3(camera[3]), direction, scatterings, engine);
        Cell& cell = cells[y * kColumns + x];
        cell.sum += light;
        cell.squares += light * light;
        ++cell.count;
      }
  };
  {
    std::jthread other([&] {
      for (uint32_t y = 1; y < kRows; y += 2) row(y);
    });
    for (uint32_t y = 0; y < kRows; y += 2) row(y);
  }
  return cells;
}

TEST(ReferenceBruteForce, CornellBox) {
  const std::filesystem::path file =
      source_dir() / "../shared/scenes/cornell_box_original_emissive/scene_lambertian.gltf";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  const scene::Scene scene = scene::load_scene(file);
  constexpr uint32_t kBounces = 2;
  const std::vector<Cell> cells = brute_force(scene, 20000, kBounces + 1);

  reference::ImageSettings settings;
  settings.width = kColumns;
  settings.height = kRows;
  settings.paths = 4000;
  settings.path.bounces = kBounces;
  const Traced traced = trace(scene, settings, {.box = true});

  double squares = 0, worst = 0, difference = 0, variance = 0;
  uint32_t compared = 0;
  for (size_t i = 0; i < cells.size(); ++i)
    for (int channel = 0; channel < 3; ++channel) {
      const auto n = static_cast<double>(cells[i].count);
      const double mean = cells[i].sum[channel] / n;
      const double own = (cells[i].squares[channel] / n - mean * mean) / (n - 1);
      const double other = std::pow(static_cast<double>(traced.pixels[i].standard_error[channel]), 2);
      const double error = static_cast<double>(traced.pixels[i].outgoing[channel]) - mean;
      if (own == 0 && other == 0) {
        EXPECT_EQ(error, 0);
        continue;
      }
      difference += error;
      variance += 3 * (own + other);
      // Where chance hardly ever meets the light its spread is not known, either.
      if (std::sqrt(own) > 0.1 * mean) continue;
      squares += error * error / (own + other);
      worst = std::max(worst, std::abs(error) / std::sqrt(own + other));
      ++compared;
    }
  ASSERT_GT(compared, 250U);
  EXPECT_LT(worst, 5);
  // Channels of a cell are correlated, so there are about a third as many independent numbers.
  EXPECT_NEAR(squares / compared, 1, 5 * std::sqrt(2.0 / (compared / 3)));
  EXPECT_LT(std::abs(difference), 4 * std::sqrt(variance));
}

}  // namespace
}  // namespace lightloom::test
