#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "framework/scene/scene.hpp"

namespace lightloom::reference {

/// What is seen through a point of the image.
struct ViewRay {
  glm::dvec3 origin{0};            ///< the viewer; for an orthographic camera a point before the whole scene [m]
  glm::dvec3 direction{0, 0, -1};  ///< unit
};

/// Rays of a camera. Pixels count from the upper left corner, centres lie at halves; both edges of a pixel are as long.
class PixelCamera {
 public:
  /// `width`, `height`: of the image whose pixels are meant [pixels].
  PixelCamera(const scene::Camera& camera, uint32_t width, uint32_t height, const scene::Bounds& bounds);

  [[nodiscard]] ViewRay through(double x, double y) const;
  /// The ray that a point in the scene lies on.
  [[nodiscard]] ViewRay towards(const glm::vec3& position) const;
  /// The ray `dx` pixels to the right of another and `dy` below it.
  [[nodiscard]] ViewRay beside(const ViewRay& ray, double dx, double dy) const;
  [[nodiscard]] const glm::dvec2& pixels() const { return pixels_; }  ///< in x and y
  /// Unit, towards the viewer.
  [[nodiscard]] glm::vec3 to_viewer(const glm::vec3& position) const;

 private:
  [[nodiscard]] ViewRay ray_of(const glm::dvec2& on_image) const;

  glm::dmat3 axes_;  ///< right, up and back of the camera
  glm::dmat3 inverse_;
  glm::dvec3 eye_;
  bool perspective_;
  glm::dvec2 half_size_;  ///< of the image, at distance 1 or, orthographic, in metres
  glm::dvec2 pixels_;
  double before_ = 0;  ///< orthographic: how far behind the camera's plane rays start
};

}  // namespace lightloom::reference
