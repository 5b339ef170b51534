#pragma once

#include <cstdint>
#include <filesystem>

#include "framework/base/file_watch.hpp"

namespace lightloom::scene {

/// Hash of the bytes of a scene file and of every file that it names (buffers, textures, instances, environment), in
/// the order in which it names them; where the files lie does not count. Throws Error(invalid_input) when a file cannot
/// be read.
[[nodiscard]] uint64_t content_hash(const std::filesystem::path& scene_file);

/// The same files one by one, as they are now; a scene file that cannot be read is among them, as empty.
[[nodiscard]] FileContents content_files(const std::filesystem::path& scene_file);

}  // namespace lightloom::scene
