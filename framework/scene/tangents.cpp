#include "framework/scene/tangents.hpp"

#include <algorithm>
#include <numeric>

#include "framework/scene/basis.hpp"

namespace lightloom::scene {
namespace {

glm::vec2 texcoord_of(const Vertex& vertex, uint32_t set) {
  return set == 0 ? glm::vec2(vertex.u0, vertex.v0) : vertex.uv1;
}

struct FaceFrame {
  glm::dvec3 tangent{0};
  int orientation = 0;  ///< +1, -1; 0: the texture coordinates are degenerate
};

// Solves edge = du * T + dv * B for the two edges of a face. With glTF's v pointing down the image, the bitangent is
// the direction of decreasing v, so a face whose (u, v) run counter-clockwise has orientation -1.
FaceFrame face_frame(const Vertex& a, const Vertex& b, const Vertex& c, uint32_t set) {
  const glm::dvec2 d1 = glm::dvec2(texcoord_of(b, set)) - glm::dvec2(texcoord_of(a, set));
  const glm::dvec2 d2 = glm::dvec2(texcoord_of(c, set)) - glm::dvec2(texcoord_of(a, set));
  const glm::dvec3 e1 = glm::dvec3(b.position) - glm::dvec3(a.position);
  const glm::dvec3 e2 = glm::dvec3(c.position) - glm::dvec3(a.position);
  const double determinant = d1.x * d2.y - d1.y * d2.x;
  FaceFrame frame;
  const glm::dvec3 tangent = (e1 * d2.y - e2 * d1.y) * (determinant < 0 ? -1.0 : 1.0);
  const double length = glm::length(tangent);
  if (!(std::abs(determinant) > 1e-24) || !(length > 0) || !std::isfinite(length)) return frame;
  frame.tangent = tangent / length;
  frame.orientation = determinant > 0 ? -1 : 1;
  return frame;
}

double corner_angle(const glm::vec3& corner, const glm::vec3& next, const glm::vec3& previous) {
  const glm::dvec3 a = glm::dvec3(next) - glm::dvec3(corner), b = glm::dvec3(previous) - glm::dvec3(corner);
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

std::vector<FaceFrame> face_frames(const Primitive& primitive, uint32_t texcoord) {
  std::vector<FaceFrame> frames(primitive.indices.size() / 3);
  for (size_t f = 0; f < frames.size(); ++f) {
    const uint32_t* corner = &primitive.indices[f * 3];
    frames[f] = face_frame(primitive.vertices[corner[0]], primitive.vertices[corner[1]], primitive.vertices[corner[2]],
                           texcoord);
  }
  return frames;
}

// Splits vertices shared by faces of both orientations; returns the orientation of each vertex.
std::vector<int> split_mirrored(Primitive& primitive, const std::vector<FaceFrame>& frames) {
  std::vector<int> orientation(primitive.vertices.size(), 0);
  std::vector<uint32_t> twin(primitive.vertices.size(), 0);
  std::vector<uint32_t> sources(primitive.vertices.size());
  std::iota(sources.begin(), sources.end(), 0u);
  for (size_t corner = 0; corner < primitive.indices.size(); ++corner) {
    const int wanted = frames[corner / 3].orientation;
    uint32_t& vertex = primitive.indices[corner];
    if (wanted == 0) continue;
    if (orientation[vertex] == 0) orientation[vertex] = wanted;
    if (orientation[vertex] == wanted) continue;
    if (twin[vertex] == 0) {
      twin[vertex] = static_cast<uint32_t>(sources.size());
      sources.push_back(vertex);
      orientation.push_back(wanted);
    }
    vertex = twin[vertex];
  }
  if (sources.size() > primitive.vertices.size()) remap_vertices(primitive, sources);
  return orientation;
}

}  // namespace

void generate_tangents(Primitive& primitive, uint32_t texcoord) {
  const std::vector<FaceFrame> frames = face_frames(primitive, texcoord);
  const std::vector<int> orientation = split_mirrored(primitive, frames);
  std::vector<glm::dvec3> sums(primitive.vertices.size(), glm::dvec3(0));
  for (size_t corner = 0; corner < primitive.indices.size(); ++corner) {
    const size_t face = corner / 3, base = face * 3;
    if (frames[face].orientation == 0) continue;
    const auto position = [&](size_t k) { return primitive.vertices[primitive.indices[base + k % 3]].position; };
    const size_t k = corner - base;
    sums[primitive.indices[corner]] +=
        frames[face].tangent * corner_angle(position(k), position(k + 1), position(k + 2));
  }
  for (size_t i = 0; i < primitive.vertices.size(); ++i) {
    Vertex& vertex = primitive.vertices[i];
    vertex.tangent =
        glm::vec4(orthonormal_tangent(vertex.normal, glm::vec3(sums[i])), orientation[i] < 0 ? -1.0f : 1.0f);
  }
}

void make_flat_normals(Primitive& primitive) {
  remap_vertices(primitive, primitive.indices);
  std::iota(primitive.indices.begin(), primitive.indices.end(), 0u);
  for (size_t i = 0; i + 2 < primitive.vertices.size(); i += 3) {
    const glm::dvec3 area = double_area(primitive.vertices[i].position, primitive.vertices[i + 1].position,
                                        primitive.vertices[i + 2].position);
    const double length = glm::length(area);
    const glm::vec3 normal = length > 0 ? glm::vec3(area / length) : glm::vec3(0, 1, 0);
    for (size_t k = 0; k < 3; ++k) primitive.vertices[i + k].normal = normal;
  }
  primitive.flat = true;
}

}  // namespace lightloom::scene
