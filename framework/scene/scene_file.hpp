#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "framework/scene/load_options.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::scene {

/// A glTF file placed in the scene: scaled, then turned about +y, then moved.
struct InstanceSpec {
  std::filesystem::path gltf;
  std::string where;          ///< for messages: "file:line:col: instances[0]"
  glm::dvec3 translation{0};  ///< [m]
  float rotation_y = 0;       ///< [radians]
  float scale = 1;
  std::variant<int, std::string> animation = 0;  ///< index or name
  bool animation_named = false;                  ///< the file says which; a missing one is then an error
  double time_offset = 0;                        ///< [s]
};

/// A camera of a scene file, before it is known where the scene has its origin.
struct CameraSpec {
  Camera camera;          ///< all but where it is
  glm::dvec3 eye{0};      ///< [m]
  glm::dvec3 target{0};   ///< [m], another point
  glm::vec3 up{0, 1, 0};  ///< of any length, not along the view
};

/// World less `origin` [m] from the camera.
[[nodiscard]] glm::mat4 look_at_target(const CameraSpec& camera, const glm::dvec3& origin);

/// A `*.scene.json` file as written; instances[0] is the main file.
struct SceneFile {
  std::vector<InstanceSpec> instances;
  std::vector<CameraSpec> cameras;
  std::optional<Sun> sun;
  Environment environment;  ///< with the image loaded
};

/// Throws Error with file, line and column; unknown members are errors.
[[nodiscard]] SceneFile read_scene_file(const std::filesystem::path& path, const LoadOptions& options = {});

}  // namespace lightloom::scene
