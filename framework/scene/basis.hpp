#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace lightloom::scene {

/// A unit vector orthogonal to the unit vector `normal`, without a singular direction (Duff et al., "Building an
/// Orthonormal Basis, Revisited", JCGT 2017).
inline glm::vec3 any_tangent(const glm::vec3& normal) {
  const float sign = std::copysign(1.0f, normal.z);
  const float a = -1.0f / (sign + normal.z);
  return {1.0f + sign * normal.x * normal.x * a, sign * normal.x * normal.y * a, -sign * normal.x};
}

/// `vector` scaled to unit length, computed in double so that neither tiny nor huge vectors are lost; `fallback` if it
/// has no direction.
inline glm::vec3 unit_or(const glm::vec3& vector, const glm::vec3& fallback) {
  const glm::dvec3 wide(vector);
  const double length = glm::length(wide);
  return length > 0 && std::isfinite(length) ? glm::vec3(wide / length) : fallback;
}

/// `tangent` made orthogonal to the unit `normal` and unit; any orthogonal one if the two are parallel.
inline glm::vec3 orthonormal_tangent(const glm::vec3& normal, const glm::vec3& tangent) {
  const glm::vec3 unit = unit_or(tangent, glm::vec3(0));
  const glm::dvec3 n(normal);
  const glm::dvec3 projected = glm::dvec3(unit) - n * glm::dot(n, glm::dvec3(unit));
  const double length = glm::length(projected);
  return length > 1e-4 ? glm::vec3(projected / length) : any_tangent(normal);
}

/// Twice the area vector of a triangle, in double.
inline glm::dvec3 double_area(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
}

/// Whether a triangle is a line or a point, to the precision in which its corners are given.
inline bool is_degenerate(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const glm::dvec3 ab = glm::dvec3(b) - glm::dvec3(a), ac = glm::dvec3(c) - glm::dvec3(a),
                   bc = glm::dvec3(c) - glm::dvec3(b);
  const double longest = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)});
  return !(glm::length(glm::cross(ab, ac)) > 1e-9 * longest);
}

}  // namespace lightloom::scene
