#include "samples/scenes/generator/objects.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace lightloom::samples {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kSoilHeight = 0.42;

/// Leaf `number`: rises from the pot and bends over. Corners go up along the stem, so the front is the upper side.
void add_frond(Mesh& mesh, uint32_t number) {
  constexpr uint32_t kSteps = 9;
  const uint32_t ring = number % 3;
  const double angle = kTurn * (number * 0.381966 + 0.02);  // golden section: no two leaves lie over each other
  const double reach = 0.30 + 0.16 * ring, rise = 1.15 - 0.24 * ring, droop = 0.12 + 0.2 * ring, half_width = 0.12;
  const glm::dvec3 outward(std::cos(angle), 0, -std::sin(angle));
  const glm::dvec3 across = glm::cross(outward, glm::dvec3(0, 1, 0));
  const auto stem = [&](double t) {
    return outward * (0.04 + reach * t * (0.4 + 0.6 * t)) +
           glm::dvec3(0, kSoilHeight + rise * t - droop * t * t * t, 0);
  };
  const auto vertex = [&](uint32_t step, double side) {
    const double t = static_cast<double>(step) / kSteps;
    const glm::dvec3 along = glm::normalize(stem(t + 0.01) - stem(t - 0.01));
    return MeshVertex{stem(t) + across * (side * half_width),
                      glm::cross(across, along),
                      glm::dvec4(across, 1),
                      {0.5 + 0.5 * side, 1 - t}};
  };
  for (uint32_t step = 0; step < kSteps; ++step) {
    add_patch(mesh, vertex(step, -1), vertex(step, 1), vertex(step + 1, 1), vertex(step + 1, -1));
  }
}

}  // namespace

Mesh urn() {
  Mesh mesh;
  const glm::dvec3 axis(0);
  constexpr uint32_t kSegments = 64;
  const std::array<glm::dvec2, 2> underside{{{0, 0}, {0.18, 0}}};
  const std::array<glm::dvec2, 2> foot_edge{{{0.18, 0}, {0.18, 0.03}}};
  const std::array<glm::dvec2, 10> body{{{0.18, 0.03},
                                         {0.12, 0.08},
                                         {0.075, 0.16},
                                         {0.15, 0.25},
                                         {0.29, 0.42},
                                         {0.345, 0.6},
                                         {0.29, 0.77},
                                         {0.175, 0.89},
                                         {0.17, 0.97},
                                         {0.235, 1.04}}};
  const std::array<glm::dvec2, 2> lip{{{0.235, 1.04}, {0.212, 1.05}}};
  const std::array<glm::dvec2, 4> inside{{{0.212, 1.05}, {0.15, 0.97}, {0.155, 0.89}, {0.2, 0.82}}};
  const std::array<glm::dvec2, 2> bottom{{{0.2, 0.82}, {0, 0.82}}};
  add_revolution(mesh, underside, axis, kSegments, 1);
  add_revolution(mesh, foot_edge, axis, kSegments, 1);
  add_revolution(mesh, smooth_profile(body, 5), axis, kSegments, 1);
  add_revolution(mesh, lip, axis, kSegments, 1);
  add_revolution(mesh, smooth_profile(inside, 3), axis, kSegments, 1);
  add_revolution(mesh, bottom, axis, kSegments, 1);
  return mesh;
}

Mesh plinth(double half_width, double height) {
  Mesh mesh;
  const double w = half_width, shaft = half_width - 0.06;
  add_box(mesh, {-w, 0, -w}, {w, 0.1, w}, 1, kAllFaces & ~kBottom);
  add_box(mesh, {-shaft, 0.1, -shaft}, {shaft, height - 0.08, shaft}, 1, kAllFaces & ~(kBottom | kTop));
  add_box(mesh, {-w, height - 0.08, -w}, {w, height, w}, 1);
  return mesh;
}

Mesh gem() {
  Mesh mesh;
  constexpr uint32_t kSides = 8;
  const auto corner = [](double radius, double height, double i) {
    const double angle = kTurn * i / kSides;
    return glm::dvec3(radius * std::cos(angle), height, -radius * std::sin(angle));
  };
  for (uint32_t i = 0; i < kSides; ++i) {
    const glm::dvec3 waist = corner(0.25, 0.02, i), next = corner(0.25, 0.02, i + 1);
    const glm::dvec3 crown = corner(0.15, 0.2, i + 0.5), before = corner(0.15, 0.2, i - 0.5);
    add_facet(mesh, waist, next, crown);
    add_facet(mesh, before, waist, crown);
    add_facet(mesh, before, crown, {0, 0.24, 0});
    add_facet(mesh, {0, -0.32, 0}, next, waist);
  }
  return mesh;
}

Mesh gem_ring() {
  Mesh mesh;
  constexpr uint32_t kRing = 48, kTube = 10;
  const double tilt = 0.35;
  const glm::dvec3 side(std::cos(tilt), std::sin(tilt), 0), ahead(0, 0, -1), up(-std::sin(tilt), std::cos(tilt), 0);
  const auto vertex = [&](uint32_t i, uint32_t j) {
    const double around = kTurn * (i % kRing) / kRing, tube = kTurn * (j % kTube) / kTube;
    const glm::dvec3 radial = side * std::cos(around) + ahead * std::sin(around);
    const glm::dvec3 tangent = ahead * std::cos(around) - side * std::sin(around);
    const glm::dvec3 normal = radial * std::cos(tube) + up * std::sin(tube);
    return MeshVertex{
        radial * 0.345 + normal * 0.025, normal, glm::dvec4(tangent, 1), {12.0 * i / kRing, -1.0 * j / kTube}};
  };
  for (uint32_t i = 0; i < kRing; ++i) {
    for (uint32_t j = 0; j < kTube; ++j) {
      add_patch(mesh, vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    }
  }
  return mesh;
}

Mesh pot() {
  Mesh mesh;
  const glm::dvec3 axis(0);
  const std::array<glm::dvec2, 4> wall{{{0.2, 0}, {0.25, 0.2}, {0.27, 0.38}, {0.27, 0.4}}};
  const std::array<glm::dvec2, 6> rim{
      {{0.27, 0.4}, {0.29, 0.403}, {0.3, 0.415}, {0.3, 0.455}, {0.293, 0.467}, {0.28, 0.47}}};
  const std::array<glm::dvec2, 2> top{{{0.28, 0.47}, {0.25, 0.47}}};
  const std::array<glm::dvec2, 2> inside{{{0.25, 0.47}, {0.25, kSoilHeight - 0.02}}};
  for (const std::span<const glm::dvec2> run :
       {std::span<const glm::dvec2>(wall), std::span<const glm::dvec2>(rim), std::span<const glm::dvec2>(top),
        std::span<const glm::dvec2>(inside)}) {
    add_revolution(mesh, run, axis, 32, 1);
  }
  return mesh;
}

Mesh pot_soil() {
  Mesh mesh;
  const std::array<glm::dvec2, 2> disc{{{0.25, kSoilHeight}, {0, kSoilHeight}}};
  add_revolution(mesh, disc, glm::dvec3(0), 32, 1);
  return mesh;
}

Mesh fronds() {
  Mesh mesh;
  for (uint32_t number = 0; number < 24; ++number) add_frond(mesh, number);
  return mesh;
}

Mesh lamp_housing(double half_width, double height) {
  Mesh mesh;
  const double rim = 0.05;
  add_box(mesh, {0, 0, -half_width}, {0.12, height, half_width}, 1, kAllFaces & ~(kLeft | kRight));
  const auto strip = [&](double z, double y, double width, double tall) {
    add_quad(mesh, {0.12, y, z + width}, {0, 0, -width}, {0, tall, 0}, 1);
  };
  strip(-half_width, 0, 2 * half_width, rim);
  strip(-half_width, height - rim, 2 * half_width, rim);
  strip(-half_width, rim, rim, height - 2 * rim);
  strip(half_width - rim, rim, rim, height - 2 * rim);
  return mesh;
}

Mesh lamp_panel(double half_width, double height) {
  Mesh mesh;
  const double rim = 0.05;
  add_quad(mesh, {0.12, rim, half_width - rim}, {0, 0, -2 * (half_width - rim)}, {0, height - 2 * rim, 0}, UvRect{});
  return mesh;
}

}  // namespace lightloom::samples
