#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "framework/reference/scene_triangles.hpp"

namespace lightloom::reference {

/// Draws points on the emissive triangles: a triangle in proportion to the power that it emits (the mean luminance of
/// its texels, times its area, times two where both sides emit), a point uniformly on it. Every triangle of an emissive
/// material has some probability, whatever the estimate of its mean says.
class Emitters {
 public:
  Emitters(const SceneTriangles& triangles, const Materials& materials);

  [[nodiscard]] bool empty() const { return cumulative_.empty(); }
  struct Sample {
    TrianglePoint point;
    float density = 0;  ///< [m^-2]
  };
  /// `pick` picks the triangle, `point` the place on it.
  [[nodiscard]] Sample sample(const glm::vec2& pick, const glm::vec2& point) const;
  /// Density of the points on a triangle [m^-2]; 0 if it does not emit.
  [[nodiscard]] float density(uint32_t triangle) const { return densities_.empty() ? 0 : densities_[triangle]; }

 private:
  std::vector<uint32_t> triangles_;
  std::vector<double> cumulative_;  ///< probability up to and including each
  std::vector<float> densities_;    ///< by triangle of the scene
};

}  // namespace lightloom::reference
