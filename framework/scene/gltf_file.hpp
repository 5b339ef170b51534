#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace lightloom::scene {

/// An image as it lies in the file, before decoding.
struct EncodedImage {
  std::string name;  ///< for messages: "images[2] (wall.png)"
  std::string uri;   ///< empty if it lies in a buffer view
  int buffer_view = -1;
};

/// A glTF file whose JSON was checked (gltf_schema.hpp) and whose buffers were read. Indices between arrays are valid;
/// byte ranges and node structure are not yet checked.
struct GltfFile {
  std::filesystem::path path;
  std::string name;       ///< for messages
  tinygltf::Model model;  ///< `buffers[i].data` filled; `images` left empty
  std::vector<EncodedImage> images;
  std::vector<std::string> warnings;
};

/// Reads `.gltf` or `.glb`, told apart by content. Throws Error.
[[nodiscard]] GltfFile read_gltf_file(const std::filesystem::path& path);

/// Bytes of an image that lies in a buffer view, a data URI or a file beside the glTF file. Throws Error.
[[nodiscard]] std::vector<uint8_t> read_encoded_image(const GltfFile& file, const EncodedImage& image);

/// The whole of a regular file. Throws Error that names it.
[[nodiscard]] std::vector<uint8_t> read_bytes(const std::filesystem::path& path, const std::string& wanted_by);

}  // namespace lightloom::scene
