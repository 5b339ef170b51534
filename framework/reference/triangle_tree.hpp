#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

#include "framework/reference/geometry.hpp"
#include "framework/reference/materials.hpp"
#include "framework/reference/scene_triangles.hpp"

namespace lightloom::reference {

/// A viewer's ray sees what the rasteriser sees: no backs of single-sided surfaces, and textures, also those that cut
/// out, at the level of detail of its pixel.
struct ViewQuery {
  const PixelCamera* camera = nullptr;
  const ViewRay* ray = nullptr;
};

struct TriangleHit {
  TrianglePoint point;
  float t = std::numeric_limits<float>::infinity();
};

/// Finds triangles along rays, by Embree. Cut-out parts of alpha-masked surfaces are not there.
class TriangleTree {
 public:
  /// Over the triangles [first, first + count) of the scene. Throws Error (run_failed) where memory does not suffice.
  TriangleTree(const SceneTriangles& triangles, const Materials& materials, uint32_t first, uint32_t count);
  ~TriangleTree();
  TriangleTree(TriangleTree&&) noexcept;
  TriangleTree& operator=(TriangleTree&&) noexcept;

  /// Replaces `hit` by a nearer one, if there is one. `view` is null for rays of light. `triangles`: those that the
  /// tree was made of, or equal ones.
  void intersect(const SceneTriangles& triangles, const Materials& materials, const Ray& ray, const ViewQuery* view,
                 TriangleHit& hit) const;
  /// Is anything nearer than `distance`?
  [[nodiscard]] bool occluded(const SceneTriangles& triangles, const Materials& materials, const Ray& ray,
                              float distance) const;

 private:
  struct State;
  std::unique_ptr<State> state_;  ///< null without triangles
};

}  // namespace lightloom::reference
