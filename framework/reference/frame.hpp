#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace lightloom::reference {

/// A unit vector orthogonal to the unit vector `normal`.
inline glm::vec3 any_orthogonal(const glm::vec3& normal) {
  // Leaving out one of the two smaller components keeps the length away from 0.
  return std::abs(normal.x) > std::abs(normal.y)
             ? glm::vec3(-normal.z, 0, normal.x) / std::sqrt(normal.x * normal.x + normal.z * normal.z)
             : glm::vec3(0, normal.z, -normal.y) / std::sqrt(normal.y * normal.y + normal.z * normal.z);
}

/// The part of `wanted` that is orthogonal to the unit `normal`, as a unit vector; any such vector where there is none.
inline glm::vec3 orthogonal_part(const glm::vec3& normal, const glm::vec3& wanted) {
  const float length = glm::length(wanted);
  if (!(length > 0) || !std::isfinite(length)) return any_orthogonal(normal);
  const glm::vec3 unit = wanted / length;
  const glm::vec3 part = unit - normal * glm::dot(normal, unit);
  const float squared = glm::dot(part, part);
  return squared > 1e-8f ? part / std::sqrt(squared) : any_orthogonal(normal);
}

/// Right-handed: x tangent, y bitangent, z normal.
struct Frame {
  glm::vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  static Frame around(const glm::vec3& normal, const glm::vec3& tangent) {
    return {tangent, glm::cross(normal, tangent), normal};
  }
  static Frame around(const glm::vec3& normal) { return around(normal, any_orthogonal(normal)); }

  [[nodiscard]] glm::vec3 to_local(const glm::vec3& v) const {
    return {glm::dot(x, v), glm::dot(y, v), glm::dot(z, v)};
  }
  [[nodiscard]] glm::vec3 to_world(const glm::vec3& v) const { return x * v.x + y * v.y + z * v.z; }
};

}  // namespace lightloom::reference
