#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "framework/scene/scene.hpp"

namespace lightloom::stability {

/// White, no specular reflection, double sided.
[[nodiscard]] scene::Material white_lambertian();

/// A parallelogram; counter-clockwise seen from the side of cross(edge_u, edge_v).
struct QuadSpec {
  glm::vec3 corner, edge_u, edge_v;  ///< [m]
  uint32_t material = 0;
};

/// A static scene of quads, each an object of its own. Without `materials`: white Lambertian. The feature `specular` is
/// set; sun, environment and punctual lights may be added by the caller, together with their features.
[[nodiscard]] scene::Scene make_quad_scene(const std::vector<QuadSpec>& quads, std::vector<scene::Material> materials,
                                           const scene::Camera& camera);

/// Perspective camera at `eye` looking at `target` [m].
[[nodiscard]] scene::Camera look_at(const glm::vec3& eye, const glm::vec3& target, float vertical_fov_radians,
                                    const glm::vec3& up = {0, 1, 0});

}  // namespace lightloom::stability
