#include "framework/reference/voxel_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/reference/frame.hpp"

namespace lightloom::reference {
namespace {

constexpr float kLeastAlpha = 0.03f;
/// An emitter is seen if nothing lies up to this far before the point on it [voxels]: places are floats.
constexpr double kSlack = 1e-3;

/// How far along its normal a ray has to start to clear the voxels of a plane [voxels]: the plane occupies voxels whose
/// centres are at most half of |x| + |y| + |z| away, and a point lies at most as far from the centre of its voxel.
double clearance(const glm::dvec3& normal) {
  return std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z) + 0.01;
}

}  // namespace

VoxelGeometry::VoxelGeometry(const VoxelImages& images, const scene::Bounds& bounds,
                             std::span<const scene::EmissionEntry> entries, std::span<const float> areas)
    : grid_(images, bounds), emitters_(grid_, entries, areas) {}

std::optional<VoxelGeometry::Hit> VoxelGeometry::closest_hit(const Ray& ray) const {
  return grid_.first_hit(grid_.to_grid(ray.origin), glm::dvec3(ray.direction));
}

SurfacePoint VoxelGeometry::surface(const Ray& ray, const Hit& hit) const {
  const Voxel voxel = grid_.decode(hit.voxel);
  const bool front = glm::dot(voxel.normal, ray.direction) <= 0;
  const glm::vec3 normal = front ? voxel.normal : -voxel.normal;
  const glm::dvec3 origin = grid_.to_grid(ray.origin), direction(ray.direction), n(normal);
  // The ray enters the voxel somewhere on its sides; the surface is most likely at the depth of its centre.
  const glm::dvec3 met = origin + direction * hit.t;
  const glm::dvec3 centre = glm::dvec3(hit.voxel) + 0.5;
  const glm::dvec3 place = met + n * glm::dot(n, centre - met);
  SurfacePoint point;
  point.position = grid_.to_world(place);
  // A normal that faces away may belong to the other wall of an edge: then the path goes on from what was empty.
  const glm::dvec3 back = origin + direction * std::max(hit.t - 1, 0.0);
  point.origin = grid_.to_world(front ? place + n * (1.5 * clearance(n)) : back);
  point.geometric_normal = normal;
  point.normal = facing(normal, -ray.direction);
  point.tangent = orthogonal_part(point.normal, voxel.tangent);
  point.reflectance = voxel.reflectance;
  point.reflectance.alpha = glm::max(point.reflectance.alpha, glm::vec2(kLeastAlpha));
  return point;
}

LightHit VoxelGeometry::emission(const SurfacePoint& /*from*/, const Ray& ray, const Hit& hit) const {
  const Voxel voxel = grid_.decode(hit.voxel);
  const glm::vec3 radiance = emitters_.radiance(voxel, ray.direction);
  if (radiance == glm::vec3(0) || hit.axis < 0) return {radiance, 0};
  const double cosine = std::abs(static_cast<double>(ray.direction[hit.axis]));
  return {radiance, static_cast<float>(emitters_.density(voxel, hit.axis, hit.side) * hit.t * hit.t / cosine)};
}

LightSample VoxelGeometry::sample_emitter(const SurfacePoint& from, const glm::vec2& pick,
                                          const glm::vec2& point) const {
  const VoxelEmitters::Sample sample = emitters_.sample(pick, point);
  const glm::dvec3 path = sample.point - grid_.to_grid(from.origin);
  const double distance = glm::length(path);
  if (!(distance > 0)) return {};
  const glm::dvec3 direction = path / distance;
  const double cosine = -glm::dot(sample.normal, direction);
  if (!(cosine > 0)) return {};
  LightSample light;
  light.direction = glm::vec3(direction);
  light.radiance = emitters_.radiance(grid_.decode(sample.voxel), light.direction);
  light.pdf = static_cast<float>(sample.density * distance * distance / cosine);
  light.distance = static_cast<float>(distance * grid_.voxel_size());
  return light;
}

bool VoxelGeometry::occluded(const SurfacePoint& from, const LightSample& light) const {
  const glm::dvec3 origin = grid_.to_grid(from.origin);
  if (!light.point) {
    const double end = static_cast<double>(light.distance) / grid_.voxel_size() - kSlack;
    return grid_.first_hit(origin, glm::dvec3(light.direction), end).has_value();
  }
  const glm::dvec3 target = grid_.to_grid(from.position + light.direction * light.distance);
  const double distance = glm::distance(target, origin);
  const double end = distance - std::numbers::sqrt3;
  return end > 0 && grid_.first_hit(origin, (target - origin) / distance, end).has_value();
}

SurfacePoint VoxelGeometry::start(const SurfacePoint& first) const {
  SurfacePoint point = first;
  const glm::dvec3 normal(first.geometric_normal);
  point.origin = grid_.to_world(grid_.to_grid(first.position) + normal * clearance(normal));
  return point;
}

}  // namespace lightloom::reference
