#include "framework/reference/triangle_geometry.hpp"

#include <algorithm>
#include <cmath>

#include "framework/reference/frame.hpp"

namespace lightloom::reference {
namespace {

/// How far rays start from a surface, in units of the rounding of the coordinates that the distance to it is computed
/// from: those of the point and of the triangle's edges.
constexpr float kRoundings = 4 * 0x1p-23f;

/// A shadow ray ends this part of its length before the light.
constexpr float kShortened = 1 - 0x1p-20f;

struct Corners {
  glm::vec3 a, ab, ac;
};

Corners corners_of(const SceneTriangles& triangles, uint32_t index) {
  const scene::Triangle& t = triangles.triangle(index);
  const glm::vec3& a = triangles.vertex(t.a).position;
  return {a, triangles.vertex(t.b).position - a, triangles.vertex(t.c).position - a};
}

float largest(const glm::vec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Unit; edges are brought to about 1 first, as their products may leave the range of floats.
glm::vec3 face_normal(const Corners& corners, float extent) {
  if (!(extent > 0)) return {0, 1, 0};
  const glm::vec3 normal = glm::cross(corners.ab / extent, corners.ac / extent);
  const float length = glm::length(normal);
  return length > 0 ? normal / length : glm::vec3(0, 1, 0);
}

struct Place {
  glm::vec3 position, normal;  ///< unit, of the front
  float clearance = 0;         ///< [m]
};

Place place_of(const SceneTriangles& triangles, const TrianglePoint& at) {
  const Corners corners = corners_of(triangles, at.triangle);
  const float extent = std::max(largest(corners.ab), largest(corners.ac));
  const glm::vec3 position = corners.a + corners.ab * at.b + corners.ac * at.c;
  return {position, face_normal(corners, extent), kRoundings * std::max(extent, largest(position))};
}

glm::vec3 interpolated_normal(const SceneTriangles& triangles, const TrianglePoint& at, const glm::vec3& face) {
  const scene::Triangle& t = triangles.triangle(at.triangle);
  const glm::vec3 sum = triangles.vertex(t.a).normal * (1 - at.b - at.c) + triangles.vertex(t.b).normal * at.b +
                        triangles.vertex(t.c).normal * at.c;
  const float squared = glm::dot(sum, sum);
  if (!(squared > 1e-30f) || !std::isfinite(squared)) return face;
  const glm::vec3 normal = sum / std::sqrt(squared);
  return glm::dot(normal, face) < 0 ? -normal : normal;
}

/// The shading normal and the lobe's direction of a material in the frame of its texture.
void bend(const SceneTriangles& triangles, const TrianglePoint& at, const MaterialPoint& material, glm::vec3& normal,
          glm::vec3& tangent) {
  const scene::Triangle& t = triangles.triangle(at.triangle);
  const glm::vec3 along = glm::vec3(triangles.vertex(t.a).tangent) * (1 - at.b - at.c) +
                          glm::vec3(triangles.vertex(t.b).tangent) * at.b +
                          glm::vec3(triangles.vertex(t.c).tangent) * at.c;
  const glm::vec3 x = orthogonal_part(normal, along);
  const glm::vec3 y = glm::cross(normal, x) * (triangles.vertex(t.a).tangent.w < 0 ? -1.0f : 1.0f);
  normal = glm::normalize(x * material.normal.x + y * material.normal.y + normal * material.normal.z);
  tangent = x * material.direction.x + y * material.direction.y;
}

}  // namespace

StaticScene::StaticScene(const scene::Scene& scene)
    : materials(scene),
      tree(SceneTriangles(scene, {}), materials, 0, scene.static_triangle_count),
      environment(scene.environment) {
  if (scene.static_triangle_count == scene.triangles.size()) emitters.emplace(SceneTriangles(scene, {}), materials);
}

TriangleGeometry::TriangleGeometry(const StaticScene& fixed, const scene::FrameScene& frame)
    : triangles_(*frame.scene, frame.pose->dynamic_vertices), materials_(&fixed.materials), fixed_(&fixed.tree) {
  const uint32_t first = frame.scene->static_triangle_count;
  const auto count = static_cast<uint32_t>(frame.scene->triangles.size()) - first;
  if (count > 0) moving_.emplace(triangles_, *materials_, first, count);
  if (!fixed.emitters) own_emitters_.emplace(triangles_, *materials_);
  emitters_ = fixed.emitters ? &*fixed.emitters : nullptr;
  if (own_emitters_) emitters_ = &*own_emitters_;
}

std::optional<TriangleHit> TriangleGeometry::closest_hit(const Ray& ray) const {
  TriangleHit hit;
  fixed_->intersect(triangles_, *materials_, ray, nullptr, hit);
  if (moving_) moving_->intersect(triangles_, *materials_, ray, nullptr, hit);
  return std::isfinite(hit.t) ? std::optional(hit) : std::nullopt;
}

SurfacePoint TriangleGeometry::make_point(const TrianglePoint& at, const glm::vec3& direction,
                                          const MaterialPoint& material, bool needs_tangent) const {
  const Place place = place_of(triangles_, at);
  const float side = glm::dot(place.normal, direction) <= 0 ? 1.0f : -1.0f;
  SurfacePoint point;
  point.position = place.position;
  point.geometric_normal = place.normal * side;
  point.origin = place.position + point.geometric_normal * place.clearance;
  point.normal = interpolated_normal(triangles_, at, place.normal);
  if (needs_tangent) bend(triangles_, at, material, point.normal, point.tangent);
  point.normal = facing(point.normal * side, -direction);
  point.tangent = needs_tangent ? orthogonal_part(point.normal, point.tangent) : any_orthogonal(point.normal);
  point.reflectance = material.reflectance;
  return point;
}

SurfacePoint TriangleGeometry::surface(const Ray& ray, const Hit& hit) const {
  const uint32_t material = triangles_.triangle(hit.point.triangle).material;
  const Materials::Traits& traits = materials_->traits(material);
  const TexturePoint where = traits.constant ? TexturePoint{} : triangles_.texture_point(hit.point);
  return make_point(hit.point, ray.direction, materials_->at(material, where, triangles_.color(hit.point)),
                    traits.needs_tangent);
}

LightHit TriangleGeometry::emission(const SurfacePoint& from, const Ray& ray, const Hit& hit) const {
  const float density = emitters_->density(hit.point.triangle);
  if (!(density > 0)) return {};
  const uint32_t material = triangles_.triangle(hit.point.triangle).material;
  const Materials::Traits& traits = materials_->traits(material);
  const Place place = place_of(triangles_, hit.point);
  const float cosine = -glm::dot(place.normal, ray.direction);
  if (cosine <= 0 && !traits.double_sided) return {};
  const glm::vec3 path = place.position - from.origin;
  const TexturePoint where = traits.constant ? TexturePoint{} : triangles_.texture_point(hit.point);
  const glm::vec3 radiance = materials_->emission(material, where);
  return {radiance, density * glm::dot(path, path) / std::max(std::abs(cosine), 1e-12f)};
}

LightSample TriangleGeometry::sample_emitter(const SurfacePoint& from, const glm::vec2& pick,
                                             const glm::vec2& point) const {
  const Emitters::Sample sample = emitters_->sample(pick, point);
  const uint32_t material = triangles_.triangle(sample.point.triangle).material;
  const Materials::Traits& traits = materials_->traits(material);
  const Place place = place_of(triangles_, sample.point);
  const float side = glm::dot(place.normal, from.origin - place.position);
  if (side == 0 || (side < 0 && !traits.double_sided)) return {};
  const glm::vec3 path = place.position + place.normal * std::copysign(place.clearance, side) - from.origin;
  const float squared = glm::dot(path, path);
  LightSample light;
  light.distance = std::sqrt(squared);
  if (!(light.distance > 0)) return {};
  light.direction = path / light.distance;
  const float cosine = std::abs(glm::dot(place.normal, light.direction));
  if (!(cosine > 0) || glm::dot(light.direction, from.geometric_normal) <= 0) return {};
  const TexturePoint where =
      traits.constant && !traits.masked ? TexturePoint{} : triangles_.texture_point(sample.point);
  if (traits.masked && materials_->cut_out(material, where, triangles_.color(sample.point))) return {};
  light.radiance = materials_->emission(material, where);
  light.pdf = sample.density * squared / cosine;
  return light;
}

bool TriangleGeometry::occluded(const SurfacePoint& from, const LightSample& light) const {
  const Ray ray{from.origin, light.direction};
  const float distance = light.distance * kShortened;
  return fixed_->occluded(triangles_, *materials_, ray, distance) ||
         (moving_ && moving_->occluded(triangles_, *materials_, ray, distance));
}

std::optional<TrianglePoint> TriangleGeometry::seen(const PixelCamera& camera, const ViewRay& ray) const {
  const ViewQuery view{&camera, &ray};
  const Ray rounded{glm::vec3(ray.origin), glm::vec3(ray.direction)};
  TriangleHit hit;
  fixed_->intersect(triangles_, *materials_, rounded, &view, hit);
  if (moving_) moving_->intersect(triangles_, *materials_, rounded, &view, hit);
  if (!std::isfinite(hit.t)) return std::nullopt;
  const std::optional<TrianglePoint> exact = triangles_.on_triangle(hit.point.triangle, ray);
  return exact ? exact : hit.point;
}

SeenSurface TriangleGeometry::seen_surface(const PixelCamera& camera, const ViewRay& ray,
                                           const TrianglePoint& at) const {
  const uint32_t material = triangles_.triangle(at.triangle).material;
  const Materials::Traits& traits = materials_->traits(material);
  const TexturePoint where = traits.constant ? TexturePoint{} : triangles_.texture_point(at, camera, ray);
  const MaterialPoint described = materials_->at(material, where, triangles_.color(at));
  return {make_point(at, glm::vec3(ray.direction), described, traits.needs_tangent), described.emission, traits.unlit};
}

}  // namespace lightloom::reference
