#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "framework/scene/scene.hpp"

namespace lightloom::scene {

/// A glTF file placed in the scene: scaled, then turned about +y, then moved.
struct InstanceSpec {
  std::filesystem::path gltf;
  std::string where;  ///< for messages: "file:line:col: instances[0]"
  glm::vec3 translation{0};
  float rotation_y = 0;  ///< [radians]
  float scale = 1;
  std::variant<int, std::string> animation = 0;  ///< index or name
  bool animation_named = false;                  ///< the file says which; a missing one is then an error
  double time_offset = 0;                        ///< [s]
};

/// A `*.scene.json` file as written; instances[0] is the main file.
struct SceneFile {
  std::vector<InstanceSpec> instances;
  std::vector<Camera> cameras;
  std::optional<Sun> sun;
  Environment environment;  ///< with the image loaded
};

/// Throws Error with file, line and column; unknown members are errors.
[[nodiscard]] SceneFile read_scene_file(const std::filesystem::path& path);

}  // namespace lightloom::scene
