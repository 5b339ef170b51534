#pragma once

#include <cstdint>
#include <filesystem>

#include "framework/base/file_watch.hpp"
#include "framework/scene/load_options.hpp"

namespace lightloom::scene {

/// Hash of the bytes of a scene file and of every file that it names (buffers, textures, instances, environment), in
/// the order in which it names them; where the files lie does not count. Files that the loader would not read under
/// these options are left out. Throws Error(invalid_input) when a file cannot be read or goes beyond the limits.
[[nodiscard]] uint64_t content_hash(const std::filesystem::path& scene_file, const LoadOptions& options = {});

/// The same files one by one, as they are now; a scene file that cannot be read is among them, as empty.
[[nodiscard]] FileContents content_files(const std::filesystem::path& scene_file, const LoadOptions& options = {});

}  // namespace lightloom::scene
