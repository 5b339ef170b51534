#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "framework/scene/gltf_file.hpp"

namespace lightloom::scene {

[[nodiscard]] bool is_data_uri(const std::string& uri);

/// What a URI of a glTF file stands for: the content of a base64 data URI, or a file (InputContext::resolve); of a file
/// only the first `count` bytes, if given. Throws Error that names `element`.
[[nodiscard]] std::vector<uint8_t> read_uri(const GltfFile& file, const std::string& uri, const std::string& element,
                                            std::optional<uint64_t> count = std::nullopt);

}  // namespace lightloom::scene
