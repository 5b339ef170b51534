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

class InputContext;

/// A glTF file whose JSON was checked (gltf_schema.hpp) and whose buffers were read. Indices between arrays are valid;
/// byte ranges and node structure are not yet checked.
struct GltfFile {
  std::filesystem::path path;
  std::string name;                 ///< for messages
  InputContext* context = nullptr;  ///< reads what the file names; outlives the loading, no more
  tinygltf::Model model;            ///< `buffers[i].data` filled; `images` left empty
  std::vector<EncodedImage> images;
  std::vector<std::string> warnings;
};

/// Reads `.gltf` or `.glb`, told apart by content. Throws Error.
[[nodiscard]] GltfFile read_gltf_file(const std::filesystem::path& path, InputContext& context);

/// Bytes of an image that lies in a buffer view, a data URI or a file beside the glTF file. Throws Error.
[[nodiscard]] std::vector<uint8_t> read_encoded_image(const GltfFile& file, const EncodedImage& image);

}  // namespace lightloom::scene
