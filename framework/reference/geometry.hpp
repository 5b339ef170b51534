#pragma once

#include <concepts>
#include <glm/glm.hpp>
#include <limits>
#include <optional>

#include "framework/reference/bsdf.hpp"
#include "framework/reference/light_sample.hpp"

namespace lightloom::reference {

struct Ray {
  glm::vec3 origin{0};
  glm::vec3 direction{0, 0, -1};  ///< unit
};

/// A surface at the point that a path meets. What is behind a shading normal that faces away is not reflected, so the
/// normal is tilted until it just faces where the path came from.
struct SurfacePoint {
  glm::vec3 position{0};
  glm::vec3 origin{0};            ///< where rays leave: off the surface by a little more than rounding
  glm::vec3 geometric_normal{0};  ///< unit, on the side that the path came from
  glm::vec3 normal{0};            ///< unit, for shading
  glm::vec3 tangent{0};           ///< unit, orthogonal to `normal`: the lobe's x axis
  Reflectance reflectance;
};

/// What paths go through. `Hit` is what is cheap to know about where a ray ends; the rest is asked for where needed.
template <class G>
concept Geometry = requires(const G& geometry, const Ray& ray, const typename G::Hit& hit, const SurfacePoint& from,
                            const LightSample& light, const glm::vec2& random) {
  /// The first surface along a ray.
  { geometry.closest_hit(ray) } -> std::same_as<std::optional<typename G::Hit>>;
  { geometry.surface(ray, hit) } -> std::same_as<SurfacePoint>;
  /// Radiance that the surface sends back along the ray that left `from`, and the density that `sample_emitter` at
  /// `from` has there.
  { geometry.emission(from, ray, hit) } -> std::same_as<LightHit>;
  /// Does anything emit, so that `emission` may be other than black?
  { geometry.emits() } -> std::same_as<bool>;
  /// A direction from a surface point to an emitter, its radiance towards the point, whether it is visible or not, and
  /// where it is; the second pair of numbers picks the place on it.
  { geometry.sample_emitter(from, random, random) } -> std::same_as<LightSample>;
  /// Does something lie between a surface point and a light that sample_emitter, or another kind of light, gave?
  { geometry.occluded(from, light) } -> std::same_as<bool>;
  /// The first hit, which is a point of a triangle whatever the paths go through, as a place in this geometry.
  { geometry.start(from) } -> std::same_as<SurfacePoint>;
};

/// A shading normal that faces a viewer: tilted towards it where it does not.
[[nodiscard]] inline glm::vec3 facing(const glm::vec3& normal, const glm::vec3& to_viewer) {
  constexpr float kLeastCosine = 0.02f;
  const float cosine = glm::dot(normal, to_viewer);
  return cosine >= kLeastCosine ? normal : glm::normalize(normal + to_viewer * (kLeastCosine - cosine));
}

}  // namespace lightloom::reference
