#pragma once

#include <tiny_gltf.h>

#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>
#include <vector>

namespace lightloom::samples {

struct Corner {
  glm::dvec3 position, normal;
  glm::dvec4 tangent;
  glm::dvec2 uv;
};

struct SceneTriangle {
  std::array<Corner, 3> corners;  ///< world space
  std::string node;
  bool double_sided = false;
};

struct Hit {
  double distance = 0;
  bool front = false;
  const SceneTriangle* triangle = nullptr;
};

/// The committed scene read by tinygltf, which shares no code with the generator; alpha masks count as solid.
struct AtriumReader {
  explicit AtriumReader(const std::filesystem::path& file);

  /// Elements of an accessor of floats, as doubles, `width` a row.
  [[nodiscard]] std::vector<double> values(int accessor) const;
  /// Nearest hit beyond a tenth of a millimetre, by trying every triangle.
  [[nodiscard]] std::optional<Hit> cast(glm::dvec3 origin, glm::dvec3 direction) const;
  /// Middle of the bounds of what a node draws.
  [[nodiscard]] glm::dvec3 centre(const std::string& node) const;

  tinygltf::Model model;
  std::vector<SceneTriangle> triangles;

 private:
  void add_node(int index, const glm::dmat4& parent);
  void add_primitive(const tinygltf::Primitive& primitive, const std::string& node, const glm::dmat4& world);
  [[nodiscard]] std::vector<uint32_t> indices(int accessor) const;
};

}  // namespace lightloom::samples
