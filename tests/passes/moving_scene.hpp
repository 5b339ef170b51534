#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "framework/scene/scene.hpp"
#include "tests/scene/gltf_builder.hpp"

namespace lightloom::test {

/// A pinhole camera, projected on the host without matrices.
struct HostCamera {
  glm::dvec3 eye{0};
  glm::dvec3 right{1, 0, 0}, up{0, 1, 0}, back{0, 0, 1};
  double vertical_fov = 0.8;  ///< [radians]
  /// Pixel coordinates of a point; nothing behind the camera.
  [[nodiscard]] std::optional<glm::dvec2> project(const glm::dvec3& point, uint32_t width, uint32_t height) const;
  /// Not normalised direction through a place on the image [pixels].
  [[nodiscard]] glm::dvec3 ray(const glm::dvec2& pixel, uint32_t width, uint32_t height) const;
};

/// Where a point of an object that is at `now` in frame `frame` was in the frame `earlier`.
using Follow = std::function<glm::dvec3(const glm::dvec3& now, uint32_t frame, uint32_t earlier)>;

/// A scene with closed-form motion: the object "mover" (last id) before the object "wall" (id 0), 30 frames a second.
struct MovingScene {
  scene::Scene scene;
  std::function<HostCamera(uint32_t frame)> camera;
  Follow mover;
  /// The same for whatever has the id `object` (0: the wall).
  [[nodiscard]] glm::dvec3 follow(uint32_t object, const glm::dvec3& now, uint32_t frame, uint32_t earlier) const;
};

/// The camera at (0, 0, 3) that looks at the origin and stands still.
HostCamera front_view();

/// Frames that an animation lasts before it starts again.
constexpr uint32_t kAnimationFrames = 300;

/// One unit square, `size` [m] wide around the origin, that moves by `step` a frame from `start`.
MovingScene translating_scene(const glm::dvec3& start, const glm::dvec3& step, double size);
/// The same, turning by `angle` [radians] a frame around `axis`.
MovingScene rotating_scene(const glm::dvec3& axis, double angle, double size);
/// A strip of two joints: the upper one moves by `step` a frame, and points between share by their height.
MovingScene skinned_scene(const glm::dvec3& step);
/// A square whose morph target moves its upper edge by `step` a frame.
MovingScene morphed_scene(const glm::dvec3& step);
/// A square that is at `before` until frame `change`, and at `after` from it on.
MovingScene jumping_scene(const glm::dvec3& before, const glm::dvec3& after, uint32_t change);
/// A square that is there in the frames [`appear`, `vanish`) alone (its scale is 0 in all others).
MovingScene flickering_scene(uint32_t appear, uint32_t vanish);
/// The wall and a resting square before a camera that moves by `step` and turns around y by `angle` a frame.
MovingScene dolly_scene(const glm::dvec3& step, double angle);
/// The same before a camera that jumps by `offset` in the frame `cut`.
MovingScene cut_scene(const glm::dvec3& offset, uint32_t cut);

}  // namespace lightloom::test
