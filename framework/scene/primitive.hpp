#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "framework/scene/accessor.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::scene {

/// The joints that move a vertex; weights sum to 1, unused ones are 0.
struct Influence {
  std::array<uint16_t, 8> joints{};
  std::array<float, 8> weights{};
};

/// Displacements of a morph target, by vertex; an attribute that does not morph is empty.
struct MorphTarget {
  std::vector<glm::vec3> positions, normals, tangents;
};

/// Triangles with one material, in the space of their mesh.
struct Primitive {
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;      ///< three a triangle
  int material = -1;                  ///< of the file; -1: glTF's default material
  std::vector<Influence> influences;  ///< by vertex; empty: not skinned
  uint32_t joint_limit = 0;           ///< one more than the largest joint used
  std::vector<MorphTarget> targets;
  bool flat = false;  ///< normals are face normals, to be redone when the mesh deforms; corners are not shared
  size_t dropped_triangles = 0;  ///< degenerate ones
};

/// Which texture coordinates the tangents of a material follow: the normal map's, else the anisotropy's, else 0.
using TangentTexcoord = uint32_t;

/// Reads and completes one primitive: triangle list, normals, tangents. Returns no triangles for points and lines.
/// Throws Error; `path` is "meshes[0].primitives[1]".
[[nodiscard]] Primitive load_primitive(const AccessorReader& reader, const GltfFile& file,
                                       const tinygltf::Primitive& source, TangentTexcoord tangent_texcoord,
                                       const std::string& path, std::vector<std::string>& warnings);

/// Keeps vertex `sources[i]` as vertex i in all of a primitive's vertex arrays; the indices stay as they are.
void remap_vertices(Primitive& primitive, const std::vector<uint32_t>& sources);

}  // namespace lightloom::scene
