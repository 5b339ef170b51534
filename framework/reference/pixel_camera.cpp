#include "framework/reference/pixel_camera.hpp"

#include <algorithm>
#include <cmath>

namespace lightloom::reference {

PixelCamera::PixelCamera(const scene::Camera& camera, uint32_t width, uint32_t height, const scene::Bounds& bounds)
    : axes_(glm::dmat4(camera.world_from_camera)),
      inverse_(glm::inverse(axes_)),
      eye_(glm::dvec4(camera.world_from_camera[3])),
      perspective_(camera.perspective),
      pixels_(width, height) {
  const double half_height =
      perspective_ ? std::tan(0.5 * static_cast<double>(camera.vertical_fov)) : static_cast<double>(camera.half_height);
  half_size_ = {half_height * width / height, half_height};
  // An orthographic view shows what lies behind the camera's plane as well.
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 world((corner & 1) != 0 ? bounds.max.x : bounds.min.x,
                           (corner & 2) != 0 ? bounds.max.y : bounds.min.y,
                           (corner & 4) != 0 ? bounds.max.z : bounds.min.z);
    before_ = std::max(before_, std::abs((inverse_ * (world - eye_)).z) * 1.01);
  }
}

ViewRay PixelCamera::ray_of(const glm::dvec2& on_image) const {
  if (perspective_) return {eye_, glm::normalize(axes_ * glm::dvec3(on_image, -1))};
  return {eye_ + axes_ * glm::dvec3(on_image, before_), -glm::normalize(axes_[2])};
}

ViewRay PixelCamera::through(double x, double y) const {
  return ray_of(half_size_ * glm::dvec2(2 * x / pixels_.x - 1, 1 - 2 * y / pixels_.y));
}

ViewRay PixelCamera::towards(const glm::vec3& position) const {
  const glm::dvec3 local = inverse_ * (glm::dvec3(position) - eye_);
  return ray_of(perspective_ ? glm::dvec2(local) / -local.z : glm::dvec2(local));
}

ViewRay PixelCamera::beside(const ViewRay& ray, double dx, double dy) const {
  const glm::dvec3 local = inverse_ * (perspective_ ? ray.direction : ray.origin - eye_);
  const glm::dvec2 on_image = perspective_ ? glm::dvec2(local) / -local.z : glm::dvec2(local);
  return ray_of(on_image + half_size_ * glm::dvec2(2 * dx / pixels_.x, -2 * dy / pixels_.y));
}

glm::vec3 PixelCamera::to_viewer(const glm::vec3& position) const {
  return glm::vec3(perspective_ ? glm::normalize(eye_ - glm::dvec3(position)) : glm::normalize(axes_[2]));
}

}  // namespace lightloom::reference
