#pragma once

#include <cstdint>
#include <filesystem>

namespace lightloom::scene {

/// Hash of the bytes of a scene file and of every file that it names (buffers, textures, instances, environment), in
/// the order in which it names them; where the files lie does not count. Throws Error(invalid_input) when a file cannot
/// be read.
[[nodiscard]] uint64_t content_hash(const std::filesystem::path& scene_file);

}  // namespace lightloom::scene
