#pragma once

#include <filesystem>

#include "framework/base/limits.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::scene {

/// What the files of a scene may ask for.
struct LoadOptions {
  Limits limits;
  /// glTF files may name buffers and images outside of their folder and of that of the main file.
  bool allow_outside = false;
};

/// `load_scene` under limits of the caller's choice. A file that goes beyond one is an Error(invalid_input) that names
/// the element, what it claims, the limit and the option that raises it.
[[nodiscard]] Scene load_scene(const std::filesystem::path& file, const LoadOptions& options);

}  // namespace lightloom::scene
