#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "framework/reference/materials.hpp"
#include "framework/reference/pixel_camera.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::reference {

/// A point of a triangle by the weights of its corners b and c.
struct TrianglePoint {
  uint32_t triangle = 0;
  float b = 0;
  float c = 0;
};

/// The triangles of a scene in one frame: static vertices as loaded, dynamic ones as posed. Refers to both.
class SceneTriangles {
 public:
  SceneTriangles(const scene::Scene& scene, std::span<const scene::Vertex> dynamic_vertices)
      : scene_(&scene), dynamic_(dynamic_vertices) {}

  [[nodiscard]] const scene::Scene& scene() const { return *scene_; }
  [[nodiscard]] const scene::Triangle& triangle(uint32_t index) const { return scene_->triangles[index]; }
  [[nodiscard]] const scene::Vertex& vertex(uint32_t index) const {
    return index < scene_->static_vertex_count ? scene_->vertices[index]
                                               : dynamic_[index - scene_->static_vertex_count];
  }
  /// Where rays of the viewer meet the plane of a triangle, kept within the triangle; nothing if they run along it.
  [[nodiscard]] std::optional<TrianglePoint> on_triangle(uint32_t triangle, const ViewRay& ray) const;
  /// Texture coordinates at a point; at a pixel's, with their change to the pixels beside it.
  [[nodiscard]] TexturePoint texture_point(const TrianglePoint& point) const;
  [[nodiscard]] TexturePoint texture_point(const TrianglePoint& point, const PixelCamera& camera,
                                           const ViewRay& ray) const;
  [[nodiscard]] glm::vec4 color(const TrianglePoint& point) const;

 private:
  const scene::Scene* scene_;
  std::span<const scene::Vertex> dynamic_;
};

}  // namespace lightloom::reference
