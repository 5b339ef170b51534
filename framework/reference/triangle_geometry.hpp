#pragma once

#include <memory>
#include <optional>

#include "framework/reference/emitters.hpp"
#include "framework/reference/environment_light.hpp"
#include "framework/reference/geometry.hpp"
#include "framework/reference/triangle_tree.hpp"
#include "framework/scene/frame_scene.hpp"

namespace lightloom::reference {

/// What follows from the loaded scene alone: decoded materials, a tree of the triangles that never move, tables of the
/// lights that do not. Keeps a reference to the scene.
struct StaticScene {
  explicit StaticScene(const scene::Scene& scene);

  Materials materials;
  TriangleTree tree;
  EnvironmentLight environment;
  std::optional<Emitters> emitters;  ///< where no triangle moves
};

/// What the viewer sees at a point.
struct SeenSurface {
  SurfacePoint point;
  glm::vec3 emission{0};  ///< [W m^-2 sr^-1]
  bool unlit = false;     ///< the base colour is what is seen
};

/// The triangles of a scene in one frame. A surface is opaque and reflects on both sides; a single-sided one emits from
/// its front alone. Refers to what it is made of.
class TriangleGeometry {
 public:
  using Hit = TriangleHit;

  TriangleGeometry(const StaticScene& fixed, const scene::FrameScene& frame);
  TriangleGeometry(const TriangleGeometry&) = delete;
  TriangleGeometry& operator=(const TriangleGeometry&) = delete;
  ~TriangleGeometry() = default;

  [[nodiscard]] std::optional<Hit> closest_hit(const Ray& ray) const;
  [[nodiscard]] SurfacePoint surface(const Ray& ray, const Hit& hit) const;
  [[nodiscard]] LightHit emission(const SurfacePoint& from, const Ray& ray, const Hit& hit) const;
  [[nodiscard]] bool emits() const { return !emitters_->empty(); }
  [[nodiscard]] LightSample sample_emitter(const SurfacePoint& from, const glm::vec2& pick,
                                           const glm::vec2& point) const;
  [[nodiscard]] bool occluded(const SurfacePoint& from, const LightSample& light) const;
  [[nodiscard]] SurfacePoint start(const SurfacePoint& first) const { return first; }

  /// The first surface that a viewer's ray sees.
  [[nodiscard]] std::optional<TrianglePoint> seen(const PixelCamera& camera, const ViewRay& ray) const;
  [[nodiscard]] SeenSurface seen_surface(const PixelCamera& camera, const ViewRay& ray, const TrianglePoint& at) const;
  [[nodiscard]] const SceneTriangles& triangles() const { return triangles_; }

 private:
  [[nodiscard]] SurfacePoint make_point(const TrianglePoint& at, const glm::vec3& direction,
                                        const MaterialPoint& material, bool needs_tangent) const;

  SceneTriangles triangles_;
  const Materials* materials_;
  const TriangleTree* fixed_;
  std::optional<TriangleTree> moving_;
  std::optional<Emitters> own_emitters_;
  const Emitters* emitters_;
};
static_assert(Geometry<TriangleGeometry>);

}  // namespace lightloom::reference
