#pragma once

#include <string>
#include <vector>

#include "framework/scene/scene.hpp"
#include "tests/passes/light_support.hpp"

namespace lightloom::test {

/// One spatial filter: its type and its params as JSON members.
struct FilterStage {
  std::string type;
  std::string params;
};

/// A pattern (see make_pattern) through filters, one after another, on square images.
struct FilterRun {
  uint32_t size = 65;
  std::string pattern = "impulse";
  double scale = 1;
  std::vector<FilterStage> stages = {};
  std::string variance_pattern =
      {};  ///< empty: `variance` stays unconnected; else its red channel is what all stages get
  double variance_scale = 1;
  bool packed = false;  ///< neighbours are judged by what `filter_guide` packs
};

/// Outputs `radiance` and `pattern`, and the G-buffer's position and normal.
Images run_filters(const scene::Scene& scene, const FilterRun& run);

/// JSON members of a filter's params that give it the half length `metres` at roughness 1, at every distance.
std::string fixed_reach(const scene::Scene& scene, double metres);

/// A camera in doubles that shares no code with the renderer: right-handed, looking along the view direction.
struct PinholeOracle {
  glm::dvec3 eye, right, up, forward;
  double half_height;  ///< tangent of half the vertical angle
  double size;         ///< width and height [pixels]

  PinholeOracle(const glm::dvec3& eye, const glm::dvec3& target, double vertical_fov, double size);
  /// Position in pixels, y down; pixel (i, j) covers [i, i+1) x [j, j+1).
  [[nodiscard]] glm::dvec2 project(const glm::dvec3& point) const;
};

}  // namespace lightloom::test
