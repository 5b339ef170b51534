#include "samples/scenes/generator/building.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace lightloom::samples {

namespace {

constexpr double kTilePeriod = 1.6, kBrickPeriod = 1.2;
constexpr double kArchRadius = 0.9, kMouldingRadius = 1.06;
constexpr double kPierDepth = 0.2, kMouldingDepth = 0.25;  // half thickness of the arcade without and with moulding
constexpr int kBays = 5;
constexpr uint32_t kArchSegments = 24, kColumnSegments = 24;

glm::dvec2 on_arch(double centre, double radius, uint32_t i) {
  const double angle = std::numbers::pi * (1 - static_cast<double>(i) / kArchSegments);
  return {centre + radius * std::cos(angle), kImpost + radius * std::sin(angle)};
}

/// Vertex of a wall that faces +z (side = 1) or -z (side = -1).
MeshVertex wall_vertex(glm::dvec2 xy, double z, double side) {
  return {{xy, z * side}, {0, 0, side}, {side, 0, 0, 1}, {side * xy.x, -xy.y}};
}

/// Flat patch between a lower and an upper edge that both run to the right seen from +z.
void add_wall_patch(Mesh& mesh, std::array<glm::dvec2, 4> corners, double z, double side) {
  const auto [a, b, c, d] = corners;
  if (side > 0) {
    add_patch(mesh, wall_vertex(a, z, 1), wall_vertex(b, z, 1), wall_vertex(c, z, 1), wall_vertex(d, z, 1));
  } else {
    add_patch(mesh, wall_vertex(b, z, -1), wall_vertex(a, z, -1), wall_vertex(d, z, -1), wall_vertex(c, z, -1));
  }
}

/// Part of a cylinder about the arch's axis between `z_low` and `z_high`; its front faces the axis or faces away.
void add_arch_band(Mesh& mesh, double centre, double radius, uint32_t i, double z_low, double z_high, bool inward) {
  const double sign = inward ? -1 : 1;
  const auto vertex = [&](uint32_t step, double z) {
    const glm::dvec2 xy = on_arch(centre, radius, step);
    const glm::dvec2 normal = sign * (xy - glm::dvec2(centre, kImpost)) / radius;
    const double length = radius * std::numbers::pi * step / kArchSegments;
    return MeshVertex{{xy, z}, {normal, 0}, {0, 0, 1, 1}, {z, -sign * length}};
  };
  const uint32_t lower = inward ? i + 1 : i, upper = inward ? i : i + 1;
  add_patch(mesh, vertex(lower, z_low), vertex(lower, z_high), vertex(upper, z_high), vertex(upper, z_low));
}

void add_arch(Mesh& mesh, double centre) {
  for (uint32_t i = 0; i < kArchSegments; ++i) {
    const glm::dvec2 inner = on_arch(centre, kArchRadius, i), inner_next = on_arch(centre, kArchRadius, i + 1);
    const glm::dvec2 outer = on_arch(centre, kMouldingRadius, i), outer_next = on_arch(centre, kMouldingRadius, i + 1);
    for (const double side : {1.0, -1.0}) {
      add_wall_patch(mesh, {inner, inner_next, outer_next, outer}, kMouldingDepth, side);
      add_wall_patch(mesh, {outer, outer_next, {outer_next.x, kArcadeTop}, {outer.x, kArcadeTop}}, kPierDepth, side);
    }
    add_arch_band(mesh, centre, kArchRadius, i, -kMouldingDepth, kMouldingDepth, true);
    add_arch_band(mesh, centre, kMouldingRadius, i, kPierDepth, kMouldingDepth, false);
    add_arch_band(mesh, centre, kMouldingRadius, i, -kMouldingDepth, -kPierDepth, false);
  }
}

/// Flat wall above a column, between the mouldings of two arches.
void add_pier(Mesh& mesh, double from, double to) {
  for (const double side : {1.0, -1.0}) {
    add_wall_patch(mesh, {{{from, kImpost}, {to, kImpost}, {to, kArcadeTop}, {from, kArcadeTop}}}, kPierDepth, side);
  }
}

}  // namespace

Mesh floor_slab() {
  Mesh mesh;
  add_box(mesh, {-kHalfLength - kWall, -kWall, -kHalfWidth - kWall}, {kHalfLength + kWall, 0, kHalfWidth + kWall},
          kTilePeriod);
  return mesh;
}

Mesh roof_slab() {
  Mesh mesh;
  const double x = kHalfLength + kWall, z = kHalfWidth + kWall, top = kHeight + kWall;
  add_box(mesh, {-x, kHeight, -z}, {kOpeningLeft, top, z}, 1);
  add_box(mesh, {kOpeningRight, kHeight, -z}, {x, top, z}, 1);
  const uint32_t between = kAllFaces & ~(kLeft | kRight);
  add_box(mesh, {kOpeningLeft, kHeight, -z}, {kOpeningRight, top, kOpeningBack}, 1, between);
  add_box(mesh, {kOpeningLeft, kHeight, kOpeningFront}, {kOpeningRight, top, z}, 1, between);
  return mesh;
}

Mesh end_walls() {
  Mesh mesh;
  const uint32_t faces = kLeft | kRight;
  add_box(mesh, {-kHalfLength - kWall, 0, -kHalfWidth}, {-kHalfLength, kHeight, kHalfWidth}, kBrickPeriod, faces);
  add_box(mesh, {kHalfLength, 0, -kHalfWidth}, {kHalfLength + kWall, kHeight, kHalfWidth}, kBrickPeriod, faces);
  return mesh;
}

Mesh side_wall() {
  Mesh mesh;
  add_box(mesh, {-kHalfLength - kWall, 0, kHalfWidth}, {kHalfLength + kWall, kHeight, kHalfWidth + kWall}, 1,
          kAllFaces & ~(kBottom | kTop));
  return mesh;
}

Mesh beams() {
  Mesh mesh;
  for (const double x : {-4.4, -2.7, -1.0, 1.1, 3.0, 4.7}) {
    add_box(mesh, {x - 0.09, kHeight - 0.25, -kHalfWidth}, {x + 0.09, kHeight, kHalfWidth}, 1,
            kAllFaces & ~(kFront | kBack));
  }
  return mesh;
}

Mesh column() {
  Mesh mesh;
  const glm::dvec3 axis(0);
  add_box(mesh, {-0.28, 0, -0.28}, {0.28, 0.12, 0.28}, 1, kAllFaces & ~kBottom);
  const std::array<glm::dvec2, 7> base{
      {{0.235, 0.12}, {0.268, 0.155}, {0.268, 0.205}, {0.238, 0.24}, {0.222, 0.26}, {0.228, 0.29}, {0.205, 0.315}}};
  add_revolution(mesh, smooth_profile(base, 2), axis, kColumnSegments, 1);
  const std::array<glm::dvec2, 5> shaft{{{0.2, 0.315}, {0.199, 0.85}, {0.192, 1.4}, {0.18, 1.9}, {0.165, 2.3}}};
  add_revolution(mesh, shaft, axis, kColumnSegments, 1);
  const std::array<glm::dvec2, 7> capital{
      {{0.168, 2.3}, {0.188, 2.318}, {0.186, 2.342}, {0.17, 2.36}, {0.19, 2.42}, {0.235, 2.5}, {0.285, 2.56}}};
  add_revolution(mesh, smooth_profile(capital, 2), axis, kColumnSegments, 1);
  add_box(mesh, {-0.3, 2.56, -0.3}, {0.3, kImpost, 0.3}, 1);
  return mesh;
}

Mesh arcade() {
  Mesh mesh;
  const double edge = kBay / 2 - kMouldingRadius;
  for (int bay = 0; bay < kBays; ++bay) {
    const double centre = (bay - kBays / 2) * kBay;
    add_arch(mesh, centre);
    add_pier(mesh, centre - kBay / 2, centre - kBay / 2 + edge);
    add_pier(mesh, centre + kBay / 2 - edge, centre + kBay / 2);
  }
  const double pier = kHalfLength - 0.24, capital = kHalfLength - 0.3;
  add_box(mesh, {-kHalfLength, 0, -0.2}, {-pier, 2.56, 0.2}, 1, kRight | kFront | kBack);
  add_box(mesh, {-kHalfLength, 2.56, -0.3}, {-capital, kImpost, 0.3}, 1, kAllFaces & ~kLeft);
  add_box(mesh, {pier, 0, -0.2}, {kHalfLength, 2.56, 0.2}, 1, kLeft | kFront | kBack);
  add_box(mesh, {capital, 2.56, -0.3}, {kHalfLength, kImpost, 0.3}, 1, kAllFaces & ~kRight);
  return mesh;
}

Mesh gallery_slab() {
  Mesh mesh;
  const uint32_t faces = kTop | kBottom | kBack;
  add_box(mesh, {-kHalfLength, kArcadeTop, kArcade - 0.3}, {kHalfLength, kGalleryFloor, kHalfWidth}, 1, faces);
  return mesh;
}

Mesh gallery_handrail() {
  Mesh mesh;
  add_box(mesh, {-kHalfLength, kGalleryFloor + 0.8, kArcade - 0.19},
          {kHalfLength, kGalleryFloor + 0.88, kArcade - 0.09}, 1, kAllFaces & ~(kLeft | kRight));
  return mesh;
}

Mesh gallery_grille() {
  Mesh mesh;
  add_quad(mesh, {kHalfLength, kGalleryFloor, kArcade - 0.14}, {-2 * kHalfLength, 0, 0}, {0, 0.8, 0},
           {{0, 0}, {kBays * 2, 1}});
  return mesh;
}

}  // namespace lightloom::samples
