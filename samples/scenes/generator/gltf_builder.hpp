#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "samples/scenes/generator/mesh.hpp"

namespace lightloom::samples {

struct Primitive {
  Mesh mesh;
  size_t material = 0;
};

/// A node's properties; `mesh`, `camera` and `children` are indices that the builder gave out.
struct Node {
  std::string name;
  std::optional<size_t> mesh = {};
  std::optional<size_t> camera = {};
  glm::dvec3 translation{0};
  std::array<double, 4> rotation{0, 0, 0, 1};  ///< quaternion, xyzw
  std::vector<size_t> children = {};
};

/// One animated property of a node: `values` holds `width` numbers a key.
struct Channel {
  size_t node = 0;
  std::string path;  ///< "translation" or "rotation"
  std::vector<double> values;
};

/// Collects a glTF 2.0 asset and writes it as one .gltf and one .bin, byte for byte the same every time: numbers are
/// rounded to binary fractions, so that a last-bit difference of a maths library does not show.
class GltfBuilder {
 public:
  using Json = nlohmann::ordered_json;

  size_t add_texture(const std::string& uri, bool repeat);
  size_t add_material(Json material);
  size_t add_mesh(const std::string& name, std::span<const Primitive> primitives);
  size_t add_camera(const std::string& name, double vertical_fov);  ///< [radians]
  size_t add_node(const Node& node);
  void add_root(size_t node) { roots_.push_back(node); }
  void add_animation(const std::string& name, std::span<const double> times, std::span<const Channel> channels);
  void use_extension(const std::string& name) { extensions_.push_back(name); }

  /// Writes `name`.gltf and `name`.bin into `folder`. Throws std::runtime_error that names the file.
  void write(const std::filesystem::path& folder, const std::string& name) const;

 private:
  /// One bufferView each; kept apart until the end so that each has one stride and one target.
  enum Stream : size_t { kIndices, kPositions, kNormals, kTangents, kTexcoords, kKeys, kStreamCount };

  size_t add_accessor(Stream stream, std::span<const double> values, const char* type, bool bounds);
  size_t add_indices(std::span<const uint32_t> indices);

  std::array<std::vector<uint8_t>, kStreamCount> streams_;
  Json accessors_ = Json::array(), materials_ = Json::array(), meshes_ = Json::array(), nodes_ = Json::array(),
       cameras_ = Json::array(), animations_ = Json::array(), images_ = Json::array(), textures_ = Json::array();
  std::vector<size_t> roots_;
  std::vector<std::string> extensions_;
};

}  // namespace lightloom::samples
