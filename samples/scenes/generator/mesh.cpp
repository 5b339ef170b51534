#include "samples/scenes/generator/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lightloom::samples {

namespace {

uint32_t add_vertex(Mesh& mesh, const MeshVertex& vertex) {
  mesh.vertices.push_back(vertex);
  return static_cast<uint32_t>(mesh.vertices.size() - 1);
}

void add_triangle(Mesh& mesh, uint32_t a, uint32_t b, uint32_t c) {
  mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

/// Unit direction of the profile at `i`, from its neighbours.
glm::dvec2 profile_direction(std::span<const glm::dvec2> profile, size_t i) {
  const size_t before = i == 0 ? 0 : i - 1;
  const size_t after = std::min(i + 1, profile.size() - 1);
  return glm::normalize(profile[after] - profile[before]);
}

}  // namespace

void add_patch(Mesh& mesh, const MeshVertex& a, const MeshVertex& b, const MeshVertex& c, const MeshVertex& d) {
  const uint32_t first = add_vertex(mesh, a);
  add_vertex(mesh, b);
  add_vertex(mesh, c);
  add_vertex(mesh, d);
  add_triangle(mesh, first, first + 1, first + 2);
  add_triangle(mesh, first, first + 2, first + 3);
}

void add_quad(Mesh& mesh, glm::dvec3 corner, glm::dvec3 right, glm::dvec3 up, const UvRect& uv) {
  const glm::dvec3 normal = glm::normalize(glm::cross(right, up));
  const glm::dvec4 tangent(glm::normalize(right), 1);
  add_patch(mesh, {corner, normal, tangent, {uv.min.x, uv.max.y}}, {corner + right, normal, tangent, uv.max},
            {corner + right + up, normal, tangent, {uv.max.x, uv.min.y}}, {corner + up, normal, tangent, uv.min});
}

void add_quad(Mesh& mesh, glm::dvec3 corner, glm::dvec3 right, glm::dvec3 up, double period) {
  const double u = glm::dot(corner, glm::normalize(right)) / period;
  const double v = -glm::dot(corner, glm::normalize(up)) / period;
  add_quad(mesh, corner, right, up, {{u, v - glm::length(up) / period}, {u + glm::length(right) / period, v}});
}

void add_box(Mesh& mesh, glm::dvec3 low, glm::dvec3 high, double period, uint32_t faces) {
  const glm::dvec3 x(high.x - low.x, 0, 0), y(0, high.y - low.y, 0), z(0, 0, high.z - low.z);
  if (faces & kLeft) add_quad(mesh, low, z, y, period);
  if (faces & kRight) add_quad(mesh, {high.x, low.y, high.z}, -z, y, period);
  if (faces & kBottom) add_quad(mesh, low, x, z, period);
  if (faces & kTop) add_quad(mesh, {low.x, high.y, high.z}, x, -z, period);
  if (faces & kBack) add_quad(mesh, {high.x, low.y, low.z}, -x, y, period);
  if (faces & kFront) add_quad(mesh, {low.x, low.y, high.z}, x, y, period);
}

void add_revolution(Mesh& mesh, std::span<const glm::dvec2> profile, glm::dvec3 base, uint32_t segments, double turns) {
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  const uint32_t row = segments + 1;
  double length = 0;
  for (size_t j = 0; j < profile.size(); ++j) {
    if (j > 0) length += glm::distance(profile[j], profile[j - 1]);
    const glm::dvec2 direction = profile_direction(profile, j);
    for (uint32_t i = 0; i < row; ++i) {
      const double angle = 2 * std::numbers::pi * (i % segments) / segments;
      const glm::dvec3 radial(std::cos(angle), 0, -std::sin(angle));
      const glm::dvec3 around(-std::sin(angle), 0, -std::cos(angle));
      add_vertex(mesh, {base + radial * profile[j].x + glm::dvec3(0, profile[j].y, 0),
                        radial * direction.y - glm::dvec3(0, direction.x, 0),
                        glm::dvec4(around, 1),
                        {turns * i / segments, -length}});
    }
  }
  for (uint32_t j = 0; j + 1 < profile.size(); ++j) {
    for (uint32_t i = 0; i < segments; ++i) {
      const uint32_t a = first + j * row + i;
      const uint32_t d = a + row;
      if (profile[j].x > 0) add_triangle(mesh, a, a + 1, d + 1);
      if (profile[j + 1].x > 0) add_triangle(mesh, a, d + 1, d);
    }
  }
}

void add_facet(Mesh& mesh, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
  const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
  const glm::dvec3 right = glm::normalize(b - a);
  const glm::dvec3 up = glm::cross(normal, right);
  const glm::dvec4 tangent(right, 1);
  const uint32_t first = add_vertex(mesh, {a, normal, tangent, {0, 0}});
  add_vertex(mesh, {b, normal, tangent, {glm::distance(a, b), 0}});
  add_vertex(mesh, {c, normal, tangent, {glm::dot(c - a, right), -glm::dot(c - a, up)}});
  add_triangle(mesh, first, first + 1, first + 2);
}

std::vector<glm::dvec2> smooth_profile(std::span<const glm::dvec2> points, uint32_t steps) {
  std::vector<glm::dvec2> result;
  for (size_t span = 0; span + 1 < points.size(); ++span) {
    const glm::dvec2 p0 = points[span == 0 ? 0 : span - 1];
    const glm::dvec2 p1 = points[span];
    const glm::dvec2 p2 = points[span + 1];
    const glm::dvec2 p3 = points[std::min(span + 2, points.size() - 1)];
    for (uint32_t step = 0; step < steps; ++step) {
      const double t = static_cast<double>(step) / steps;
      result.push_back(0.5 * (2.0 * p1 + (p2 - p0) * t + (2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3) * (t * t) +
                              (3.0 * p1 - p0 - 3.0 * p2 + p3) * (t * t * t)));
    }
  }
  result.push_back(points.back());
  return result;
}

}  // namespace lightloom::samples
