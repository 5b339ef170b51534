#pragma once

#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/scene/scene.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::scene::test {

/// A folder that goes away with the object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "lightloom_scene_XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::string to_base64(const std::vector<uint8_t>& bytes) {
  static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t bits = 0;
    for (size_t k = 0; k < 3; ++k) bits = bits << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
    for (size_t k = 0; k < 4; ++k) text += i + k < bytes.size() + 1 ? digits[bits >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

/// Puts glTF files together: one buffer, one view an accessor.
class GltfBuilder {
 public:
  nlohmann::json json = {{"asset", {{"version", "2.0"}}}};

  template <typename T>
  int accessor(const std::vector<T>& values, const std::string& type, bool normalized = false) {
    const int view = buffer_view(values);
    const int component = std::is_same_v<T, float>      ? 5126
                          : std::is_same_v<T, uint32_t> ? 5125
                          : std::is_same_v<T, uint16_t> ? 5123
                          : std::is_same_v<T, int16_t>  ? 5122
                          : std::is_same_v<T, uint8_t>  ? 5121
                                                        : 5120;
    const size_t width = type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
    nlohmann::json accessor = {
        {"bufferView", view}, {"componentType", component}, {"type", type}, {"count", values.size() / width}};
    if (normalized) accessor["normalized"] = true;
    return append("accessors", accessor);
  }

  template <typename T>
  int buffer_view(const std::vector<T>& values) {
    while (bytes_.size() % 4 != 0) bytes_.push_back(0);
    const size_t offset = bytes_.size(), size = values.size() * sizeof(T);
    bytes_.resize(offset + size);
    std::memcpy(bytes_.data() + offset, values.data(), size);
    return append("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}});
  }

  int append(const std::string& array, const nlohmann::json& element) {
    json[array].push_back(element);
    return static_cast<int>(json[array].size()) - 1;
  }

  /// A mesh of one primitive without material.
  int mesh(const nlohmann::json& attributes, int indices = -1, int material = -1) {
    nlohmann::json primitive = {{"attributes", attributes}};
    if (indices >= 0) primitive["indices"] = indices;
    if (material >= 0) primitive["material"] = material;
    return append("meshes", {{"primitives", {primitive}}});
  }

  int node(const nlohmann::json& members) { return append("nodes", members); }

  /// Unit square in the xy plane facing +z, texture upright on it (u right, v down).
  int quad(int material = -1) {
    const int positions = accessor<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
    const int normals = accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    const int texcoords = accessor<float>({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2");
    const int indices = accessor<uint16_t>({0, 1, 2, 0, 2, 3}, "SCALAR");
    return mesh({{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", texcoords}}, indices, material);
  }

  /// An animation of one channel.
  int animation(int node_index, const std::string& path, const std::vector<float>& times,
                const std::vector<float>& values, const std::string& interpolation = "LINEAR") {
    const std::string type = path == "rotation" ? "VEC4" : path == "weights" ? "SCALAR" : "VEC3";
    const int input = accessor(times, "SCALAR"), output = accessor(values, type);
    return append("animations",
                  {{"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}},
                   {"channels", {{{"sampler", 0}, {"target", {{"node", node_index}, {"path", path}}}}}}});
  }

  [[nodiscard]] nlohmann::json finished() const {
    nlohmann::json result = json;
    if (!bytes_.empty()) {
      result["buffers"] = {
          {{"byteLength", bytes_.size()}, {"uri", "data:application/octet-stream;base64," + to_base64(bytes_)}}};
    }
    return result;
  }

  [[nodiscard]] std::string gltf() const { return finished().dump(); }

  [[nodiscard]] std::string glb() const {
    nlohmann::json document = json;
    document["buffers"] = {{{"byteLength", bytes_.size()}}};
    std::string text = document.dump(), binary(bytes_.begin(), bytes_.end());
    while (text.size() % 4 != 0) text += ' ';
    while (binary.size() % 4 != 0) binary += '\0';
    const auto u32 = [](size_t value) {
      std::string result(4, '\0');
      for (size_t k = 0; k < 4; ++k) result[k] = static_cast<char>(value >> (8 * k) & 255u);
      return result;
    };
    return "glTF" + u32(2) + u32(12 + 16 + text.size() + binary.size()) + u32(text.size()) + "JSON" + text +
           u32(binary.size()) + std::string("BIN\0", 4) + binary;
  }

  [[nodiscard]] Scene load() const {
    const TemporaryFolder folder;
    return load_scene(folder.write("scene.gltf", gltf()));
  }

 private:
  std::vector<uint8_t> bytes_;
};

/// 2 x 2 PNG files, made by hand: stored deflate blocks need no compressor.
std::vector<uint8_t> make_png(uint32_t width, uint32_t height, int bit_depth, int color_type,
                              const std::vector<uint8_t>& rows);

/// Where the shared scenes lie; empty if they are absent.
inline std::filesystem::path shared_scenes() {
  const std::filesystem::path path = source_dir() / "../shared/scenes";
  return std::filesystem::is_directory(path) ? std::filesystem::weakly_canonical(path) : std::filesystem::path();
}

}  // namespace lightloom::scene::test

/// Ends a test with a message if a shared scene is absent.
#define LIGHTLOOM_NEED_SHARED(variable)                                             \
  const std::filesystem::path variable = ::lightloom::scene::test::shared_scenes(); \
  if (variable.empty()) GTEST_SKIP() << "../shared/scenes is absent, so this test did not look at real scenes"
