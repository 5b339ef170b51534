#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>

namespace lightloom::test {

/// A triangle in grid units, in double precision.
using GridTriangle = std::array<glm::dvec3, 3>;

/// Does the triangle meet the voxel's closed cube, widened by `margin` on every side? Separating axes (Akenine-Möller
/// 2001): the cube's faces, the triangle's plane, and the nine products of their edges. Shares nothing with the
/// shader's projections.
inline bool touches_voxel(const GridTriangle& triangle, const glm::ivec3& voxel, double margin) {
  const glm::dvec3 center = glm::dvec3(voxel) + 0.5;
  const std::array<glm::dvec3, 3> corners = {triangle[0] - center, triangle[1] - center, triangle[2] - center};
  const std::array<glm::dvec3, 3> edges = {corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]};
  const std::array<glm::dvec3, 3> axes = {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)};
  const auto separated = [&](const glm::dvec3& axis) {
    const double length = glm::length(axis);
    if (length < 1e-12) return false;
    const std::array<double, 3> at = {glm::dot(axis, corners[0]), glm::dot(axis, corners[1]),
                                      glm::dot(axis, corners[2])};
    const double reach = (0.5 + margin) * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z));
    return *std::min_element(at.begin(), at.end()) > reach || *std::max_element(at.begin(), at.end()) < -reach;
  };
  if (separated(glm::cross(edges[0], edges[1]))) return false;
  return std::none_of(axes.begin(), axes.end(), [&](const glm::dvec3& axis) {
    return separated(axis) || std::any_of(edges.begin(), edges.end(),
                                          [&](const glm::dvec3& edge) { return separated(glm::cross(axis, edge)); });
  });
}

/// Point of the segment from a to b that is nearest to p.
inline glm::dvec3 nearest_on_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = b - a;
  const double squared = glm::dot(along, along);
  return squared > 0 ? a + along * std::clamp(glm::dot(p - a, along) / squared, 0.0, 1.0) : a;
}

/// Point of the triangle that is nearest to p: the foot on its plane where that lies inside, else the best of its
/// edges.
inline glm::dvec3 nearest_on_triangle(const glm::dvec3& p, const GridTriangle& t) {
  const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  const double squared = glm::dot(normal, normal);
  if (squared > 0) {
    const glm::dvec3 foot = p - normal * (glm::dot(p - t[0], normal) / squared);
    bool inside = true;
    for (size_t i = 0; i < 3; ++i) {
      const glm::dvec3& from = t[i];
      const glm::dvec3& to = t[(i + 1) % 3];
      inside = inside && glm::dot(glm::cross(to - from, foot - from), normal) >= 0;
    }
    if (inside) return foot;
  }
  glm::dvec3 best = t[0];
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec3 candidate = nearest_on_segment(p, t[i], t[(i + 1) % 3]);
    if (glm::distance(p, candidate) < glm::distance(p, best)) best = candidate;
  }
  return best;
}

}  // namespace lightloom::test
