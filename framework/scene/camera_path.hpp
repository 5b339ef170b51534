#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "framework/base/limits.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::scene {

/// Where a camera is at a moment and where it looks.
struct CameraKey {
  double time = 0;         ///< [s]
  glm::dvec3 position{0};  ///< [m]
  /// A point that the camera looks at [m], or world from camera (looks along -z).
  std::variant<glm::dvec3, glm::dquat> aim;
  std::optional<double> vertical_fov;  ///< [radians]; without it the camera's own
};

/// How positions, targets and fields of view run between the keyframes; rotations always turn evenly (slerp, the
/// shorter way round).
enum class PathInterpolation : uint8_t {
  linear,
  /// Cubic Hermite curve whose slope at a keyframe is that of the parabola through it and its two neighbours (Catmull
  /// and Rom 1974, with the keyframes' times as knots): velocity has no jumps even where times are not evenly spaced.
  /// At the first and the last keyframe the slope is that of the line to the next.
  catmull_rom,
};

/// A path of a camera through the scene. Before its first keyframe and after its last one the camera rests there.
struct CameraPath {
  std::filesystem::path file;
  PathInterpolation interpolation = PathInterpolation::catmull_rom;
  glm::dvec3 up{0, 1, 0};       ///< with targets: the direction that is up in the image
  std::vector<CameraKey> keys;  ///< at least one; times ascend; all aim alike; all or none have a field of view
};

/// Reads a camera path file (docs/scene_files.md). Throws Error(invalid_input) with file, line and column; unknown
/// members are errors.
[[nodiscard]] CameraPath read_camera_path(const std::filesystem::path& path, const Limits& limits = {});

/// `camera` at `time` [s] of the path: its pose, in the world less `origin` [m], and its field of view if the path has
/// one.
[[nodiscard]] Camera camera_on_path(const CameraPath& path, double time, Camera camera,
                                    const glm::dvec3& origin = glm::dvec3(0));

[[nodiscard]] std::string to_string(PathInterpolation interpolation);

}  // namespace lightloom::scene
