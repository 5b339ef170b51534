#include "samples/scenes/atrium_reader.hpp"

#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <stdexcept>

namespace lightloom::samples {

namespace {

bool keep_encoded(tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int, void*) {
  return true;
}

template <typename T>
T element(const tinygltf::Model& model, const tinygltf::Accessor& accessor, size_t row, size_t column) {
  const tinygltf::BufferView& view = model.bufferViews.at(accessor.bufferView);
  const size_t stride = accessor.ByteStride(view);
  T value;
  std::memcpy(&value,
              model.buffers.at(view.buffer).data.data() + view.byteOffset + accessor.byteOffset + row * stride +
                  column * sizeof(T),
              sizeof(T));
  return value;
}

}  // namespace

AtriumReader::AtriumReader(const std::filesystem::path& file) {
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(keep_encoded, nullptr);
  std::string problem, warning;
  if (!loader.LoadASCIIFromFile(&model, &problem, &warning, file.string())) throw std::runtime_error(problem);
  for (const int root : model.scenes.at(0).nodes) add_node(root, glm::dmat4(1));
}

std::vector<double> AtriumReader::values(int index) const {
  const tinygltf::Accessor& accessor = model.accessors.at(index);
  const auto width = static_cast<size_t>(tinygltf::GetNumComponentsInType(accessor.type));
  std::vector<double> result;
  for (size_t row = 0; row < accessor.count; ++row) {
    for (size_t column = 0; column < width; ++column) {
      result.push_back(static_cast<double>(element<float>(model, accessor, row, column)));
    }
  }
  return result;
}

std::vector<uint32_t> AtriumReader::indices(int index) const {
  const tinygltf::Accessor& accessor = model.accessors.at(index);
  std::vector<uint32_t> result;
  for (size_t row = 0; row < accessor.count; ++row) result.push_back(element<uint16_t>(model, accessor, row, 0));
  return result;
}

void AtriumReader::add_node(int index, const glm::dmat4& parent) {
  const tinygltf::Node& node = model.nodes.at(index);
  glm::dmat4 world = parent;
  if (!node.translation.empty()) {
    world = glm::translate(world, {node.translation[0], node.translation[1], node.translation[2]});
  }
  if (!node.rotation.empty()) {
    world = world * glm::mat4_cast(glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]));
  }
  if (node.mesh >= 0) {
    for (const auto& primitive : model.meshes.at(node.mesh).primitives) add_primitive(primitive, node.name, world);
  }
  for (const int child : node.children) add_node(child, world);
}

void AtriumReader::add_primitive(const tinygltf::Primitive& primitive, const std::string& node,
                                 const glm::dmat4& world) {
  const auto positions = values(primitive.attributes.at("POSITION")),
             normals = values(primitive.attributes.at("NORMAL"));
  const auto tangents = values(primitive.attributes.at("TANGENT")), uvs = values(primitive.attributes.at("TEXCOORD_0"));
  const glm::dmat3 turn(world);  // no node is scaled
  const std::vector<uint32_t> list = indices(primitive.indices);
  for (size_t i = 0; i + 2 < list.size(); i += 3) {
    SceneTriangle triangle{{}, node, model.materials.at(primitive.material).doubleSided};
    for (size_t k = 0; k < 3; ++k) {
      const size_t v = list[i + k];
      triangle.corners[k] = {
          glm::dvec3(world * glm::dvec4(positions.at(3 * v), positions.at(3 * v + 1), positions.at(3 * v + 2), 1)),
          turn * glm::dvec3(normals.at(3 * v), normals.at(3 * v + 1), normals.at(3 * v + 2)),
          {turn * glm::dvec3(tangents.at(4 * v), tangents.at(4 * v + 1), tangents.at(4 * v + 2)),
           tangents.at(4 * v + 3)},
          {uvs.at(2 * v), uvs.at(2 * v + 1)}};
    }
    triangles.push_back(triangle);
  }
}

std::optional<Hit> AtriumReader::cast(glm::dvec3 origin, glm::dvec3 direction) const {
  Hit best{std::numeric_limits<double>::max(), false, nullptr};
  for (const SceneTriangle& triangle : triangles) {
    const glm::dvec3 a = triangle.corners[0].position;
    const glm::dvec3 e1 = triangle.corners[1].position - a, e2 = triangle.corners[2].position - a;
    const glm::dvec3 p = glm::cross(direction, e2);
    const double determinant = glm::dot(e1, p);
    if (determinant == 0) continue;
    const double u = glm::dot(origin - a, p) / determinant;
    if (u < 0 || u > 1) continue;
    const glm::dvec3 q = glm::cross(origin - a, e1);
    const double v = glm::dot(direction, q) / determinant;
    if (v < 0 || u + v > 1) continue;
    const double distance = glm::dot(e2, q) / determinant;
    if (distance > 1e-4 && distance < best.distance) best = {distance, determinant > 0, &triangle};
  }
  if (best.triangle == nullptr) return std::nullopt;
  return best;
}

glm::dvec3 AtriumReader::centre(const std::string& node) const {
  glm::dvec3 low(1e9), high(-1e9);
  for (const SceneTriangle& triangle : triangles) {
    if (triangle.node != node) continue;
    for (const Corner& corner : triangle.corners) {
      low = glm::min(low, corner.position);
      high = glm::max(high, corner.position);
    }
  }
  return 0.5 * (low + high);
}

}  // namespace lightloom::samples
