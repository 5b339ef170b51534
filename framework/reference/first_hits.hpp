#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "framework/reference/triangle_geometry.hpp"

namespace lightloom::reference {

/// A G-buffer (bundle `surface`), as far as first hits need it, row by row.
struct SurfaceImages {
  uint32_t width = 0, height = 0;
  std::span<const glm::vec4> position;  ///< xyz [m]; w: view depth, 0 for the background
  std::span<const glm::uvec4> id;       ///< z: index of the triangle
  std::span<const glm::vec4> normal;    ///< shading normal, 1
  std::span<const glm::vec4> albedo;    ///< base colour, metallic
  std::span<const glm::vec4> material;  ///< alpha x, alpha y, F0, F90
};

/// Where the paths of a pixel start.
struct FirstHit {
  ViewRay ray;
  std::optional<SeenSurface> surface;  ///< none: background
  /// What light is divided by before it is filtered, and multiplied by again afterwards: what either lobe, and both
  /// together, would reflect to the viewer under even light, at least 1e-3.
  Lobes modulation;
  glm::vec3 modulation_sum{1};
};

/// First hits by rays through points of the image.
[[nodiscard]] FirstHit hit_through(const TriangleGeometry& geometry, const PixelCamera& camera, double x, double y);

/// The first hit that a G-buffer names: the ray through its point meets the plane of its triangle. The modulation is
/// that of the G-buffer, so that who multiplies by it again gets the light itself.
/// Throws Error (invalid_input) where the G-buffer names a triangle that the scene does not have.
[[nodiscard]] FirstHit hit_of_surface(const TriangleGeometry& geometry, const PixelCamera& camera,
                                      const SurfaceImages& images, uint32_t x, uint32_t y);

}  // namespace lightloom::reference
