#include "framework/reference/scene_triangles.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lightloom::reference {
namespace {

/// Weights of the corners b and c where a ray meets the plane of a triangle, which may be outside of it.
std::optional<glm::dvec2> plane_weights(const glm::dvec3& a, const glm::dvec3& ab, const glm::dvec3& ac,
                                        const ViewRay& ray) {
  const glm::dvec3 normal = glm::cross(ab, ac);
  const double along = glm::dot(normal, ray.direction);
  const double squared = glm::dot(normal, normal);
  if (along == 0 || squared == 0) return std::nullopt;
  const double t = glm::dot(normal, a - ray.origin) / along;
  const glm::dvec3 from_a = ray.origin + ray.direction * t - a;
  const glm::dvec2 weights(glm::dot(glm::cross(from_a, ac), normal) / squared,
                           glm::dot(glm::cross(ab, from_a), normal) / squared);
  return std::isfinite(weights.x) && std::isfinite(weights.y) ? std::optional(weights) : std::nullopt;
}

TrianglePoint within(uint32_t triangle, const glm::dvec2& weights) {
  const double b = std::clamp(weights.x, 0.0, 1.0), c = std::clamp(weights.y, 0.0, 1.0);
  const double excess = std::max(1.0, b + c);
  return {triangle, static_cast<float>(b / excess), static_cast<float>(c / excess)};
}

std::array<glm::vec2, 2> texcoords(const scene::Vertex& vertex) {
  return {glm::vec2(vertex.u0, vertex.v0), vertex.uv1};
}

glm::vec4 unpacked(uint32_t color) {
  return glm::vec4(color & 255u, color >> 8 & 255u, color >> 16 & 255u, color >> 24) / 255.0f;
}

}  // namespace

std::optional<TrianglePoint> SceneTriangles::on_triangle(uint32_t index, const ViewRay& ray) const {
  const scene::Triangle& t = triangle(index);
  const glm::dvec3 a(vertex(t.a).position);
  const auto weights =
      plane_weights(a, glm::dvec3(vertex(t.b).position) - a, glm::dvec3(vertex(t.c).position) - a, ray);
  return weights ? std::optional(within(index, *weights)) : std::nullopt;
}

TexturePoint SceneTriangles::texture_point(const TrianglePoint& point) const {
  const scene::Triangle& t = triangle(point.triangle);
  const auto a = texcoords(vertex(t.a)), b = texcoords(vertex(t.b)), c = texcoords(vertex(t.c));
  TexturePoint result;
  for (size_t set = 0; set < 2; ++set)
    result.uv[set] = a[set] * (1 - point.b - point.c) + b[set] * point.b + c[set] * point.c;
  return result;
}

TexturePoint SceneTriangles::texture_point(const TrianglePoint& point, const PixelCamera& camera,
                                           const ViewRay& ray) const {
  TexturePoint result = texture_point(point);
  const scene::Triangle& t = triangle(point.triangle);
  const auto a = texcoords(vertex(t.a)), b = texcoords(vertex(t.b)), c = texcoords(vertex(t.c));
  const glm::dvec3 corner(vertex(t.a).position);
  const glm::dvec3 ab = glm::dvec3(vertex(t.b).position) - corner, ac = glm::dvec3(vertex(t.c).position) - corner;
  const auto here = plane_weights(corner, ab, ac, ray);
  const auto right = plane_weights(corner, ab, ac, camera.beside(ray, 1, 0));
  const auto below = plane_weights(corner, ab, ac, camera.beside(ray, 0, 1));
  if (!here || !right || !below) return result;
  result.filtered = true;
  for (size_t set = 0; set < 2; ++set) {
    const glm::vec2 over_b = b[set] - a[set], over_c = c[set] - a[set];
    const glm::vec2 dx(*right - *here), dy(*below - *here);
    result.dx[set] = over_b * dx.x + over_c * dx.y;
    result.dy[set] = over_b * dy.x + over_c * dy.y;
  }
  return result;
}

glm::vec4 SceneTriangles::color(const TrianglePoint& point) const {
  const scene::Triangle& t = triangle(point.triangle);
  const uint32_t a = vertex(t.a).color, b = vertex(t.b).color, c = vertex(t.c).color;
  if ((a & b & c) == 0xFFFFFFFFu) return glm::vec4(1);
  return unpacked(a) * (1 - point.b - point.c) + unpacked(b) * point.b + unpacked(c) * point.c;
}

}  // namespace lightloom::reference
