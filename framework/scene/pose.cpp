#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "framework/scene/basis.hpp"
#include "framework/scene/fail.hpp"
#include "framework/scene/source.hpp"

namespace lightloom::scene {
namespace {

template <typename T>
using Matrix = glm::mat<4, 4, T>;

template <typename T>
Matrix<T> compose(const SourceNode& node) {
  if (node.matrix) return Matrix<T>(*node.matrix);
  Matrix<T> matrix = glm::mat4_cast(glm::qua<T>(node.rotation));
  matrix[0] *= static_cast<T>(node.scale.x);
  matrix[1] *= static_cast<T>(node.scale.y);
  matrix[2] *= static_cast<T>(node.scale.z);
  matrix[3] = glm::vec<4, T>(glm::vec<3, T>(node.translation), 1);
  return matrix;
}

template <typename T>
std::vector<glm::dmat4> compose_all(const std::vector<SourceNode>& nodes) {
  std::vector<Matrix<T>> world;
  world.reserve(nodes.size());
  for (const SourceNode& node : nodes) {
    const Matrix<T> local = compose<T>(node);
    world.push_back(node.parent < 0 ? local : world[static_cast<size_t>(node.parent)] * local);
  }
  return {world.begin(), world.end()};
}

double determinant(const glm::mat4& matrix) {
  return glm::determinant(glm::dmat3(matrix));
}

// The cofactor matrix is the inverse transpose times the determinant, and exists for flattened meshes too; the sign
// keeps outward normals outward under mirroring.
glm::dmat3 normal_matrix(const glm::mat4& matrix) {
  const glm::dmat3 m(matrix);
  const glm::dmat3 cofactor(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  return determinant(matrix) < 0 ? -cofactor : cofactor;
}

glm::vec3 transform_point(const glm::dmat4& matrix, bool far_off, const glm::vec3& point) {
  if (far_off) return glm::vec3(matrix * glm::dvec4(point, 1));
  return glm::vec3(glm::mat4(matrix) * glm::vec4(point, 1));
}

/// All but the position.
void turn_vertex(const glm::mat4& matrix, const glm::dmat3& normals, double handedness, Vertex& vertex) {
  const glm::dvec3 normal = normals * glm::dvec3(vertex.normal);
  const double length = glm::length(normal);
  if (length > 0) vertex.normal = glm::vec3(normal / length);
  const glm::vec3 tangent = glm::mat3(matrix) * glm::vec3(vertex.tangent);
  vertex.tangent =
      glm::vec4(orthonormal_tangent(vertex.normal, tangent), handedness < 0 ? -vertex.tangent.w : vertex.tangent.w);
}

void morph(const Primitive& primitive, const std::vector<float>& weights, std::span<Vertex> vertices) {
  const size_t count = std::min(primitive.targets.size(), weights.size());
  for (size_t t = 0; t < count; ++t) {
    const MorphTarget& target = primitive.targets[t];
    const float weight = weights[t];
    if (weight == 0) continue;
    for (size_t i = 0; i < vertices.size(); ++i) {
      if (!target.positions.empty()) vertices[i].position += weight * target.positions[i];
      if (!target.normals.empty()) vertices[i].normal += weight * target.normals[i];
      if (!target.tangents.empty()) vertices[i].tangent += glm::vec4(weight * target.tangents[i], 0);
    }
  }
  for (size_t i = 0; i < vertices.size(); ++i) {
    vertices[i].normal = unit_or(vertices[i].normal, primitive.vertices[i].normal);
  }
}

template <typename T>
std::vector<Matrix<T>> joint_matrices(const SourceSkin& skin, const NodeState& state) {
  std::vector<Matrix<T>> matrices(skin.joints.size());
  for (size_t j = 0; j < matrices.size(); ++j)
    matrices[j] = Matrix<T>(state.world[static_cast<size_t>(skin.joints[j])]) * Matrix<T>(skin.inverse_bind[j]);
  return matrices;
}

template <typename T>
Matrix<T> blend(const std::vector<Matrix<T>>& joints, const Influence& influence) {
  Matrix<T> matrix(0);
  for (size_t k = 0; k < influence.weights.size(); ++k) {
    if (influence.weights[k] > 0) matrix += static_cast<T>(influence.weights[k]) * joints[influence.joints[k]];
  }
  return matrix;
}

template <typename T>
void pose_skinned(const Draw& draw, const SourceSkin& skin, const NodeState& state, std::span<Vertex> out) {
  const std::vector<Matrix<T>> joints = joint_matrices<T>(skin, state);
  for (size_t i = 0; i < out.size(); ++i) {
    const Matrix<T> blended = blend(joints, draw.primitive->influences[i]);
    const glm::mat4 matrix(blended);
    out[i].position = transform_point(glm::dmat4(blended), state.far_off, out[i].position);
    turn_vertex(matrix, normal_matrix(matrix), determinant(matrix), out[i]);
  }
}

void redo_flat_normals(bool mirrored, std::span<Vertex> vertices) {
  for (size_t i = 0; i + 2 < vertices.size(); i += 3) {
    const glm::dvec3 area = double_area(vertices[i].position, vertices[i + 1].position, vertices[i + 2].position);
    const double length = glm::length(area);
    if (!(length > 0)) continue;
    const glm::vec3 normal(area / (mirrored ? -length : length));
    for (size_t k = 0; k < 3; ++k) {
      Vertex& vertex = vertices[i + k];
      vertex.normal = normal;
      vertex.tangent = glm::vec4(orthonormal_tangent(normal, glm::vec3(vertex.tangent)), vertex.tangent.w);
    }
  }
}

std::vector<SourceNode> nodes_at(const SceneSource& source, double time) {
  std::vector<SourceNode> nodes = source.nodes;
  for (const Clip& clip : source.clips) {
    const double local = clip_time(clip, time);
    for (const Track& track : clip.tracks)
      apply_track_value(track, sample_track(track, local), nodes[static_cast<size_t>(track.node)]);
  }
  return nodes;
}

}  // namespace

void apply_track_value(const Track& track, const std::vector<float>& value, SourceNode& node) {
  switch (track.path) {
    case TrackPath::translation:
      node.translation = {value[0], value[1], value[2]};
      return;
    case TrackPath::rotation:
      node.rotation = {value[3], value[0], value[1], value[2]};
      return;
    case TrackPath::scale:
      node.scale = {value[0], value[1], value[2]};
      return;
    case TrackPath::weights:
      node.weights = value;
      return;
  }
}

std::vector<glm::dmat4> world_from_nodes(const SceneSource& source) {
  return compose_all<double>(nodes_at(source, 0));
}

NodeState evaluate_nodes(const SceneSource& source, double time) {
  std::vector<SourceNode> nodes = nodes_at(source, time);
  NodeState state;
  state.far_off = source.origin != glm::dvec3(0);
  state.world = state.far_off ? compose_all<double>(nodes) : compose_all<float>(nodes);
  for (glm::dmat4& world : state.world) world[3] -= glm::dvec4(source.origin, 0);
  state.weights.reserve(nodes.size());
  for (SourceNode& node : nodes) state.weights.push_back(std::move(node.weights));
  return state;
}

bool is_mirrored(const SceneSource& source, const Draw& draw, const NodeState& state) {
  if (draw.skin < 0 || draw.primitive->influences.empty())
    return determinant(glm::mat4(state.world[static_cast<size_t>(draw.node)])) < 0;
  const std::vector<glm::mat4> joints = joint_matrices<float>(source.skins[static_cast<size_t>(draw.skin)], state);
  return determinant(blend(joints, draw.primitive->influences.front())) < 0;
}

void pose_vertices(const SceneSource& source, const Draw& draw, const NodeState& state, std::span<Vertex> out) {
  const Primitive& primitive = *draw.primitive;
  std::copy(primitive.vertices.begin(), primitive.vertices.end(), out.begin());
  if (!primitive.targets.empty()) morph(primitive, state.weights[static_cast<size_t>(draw.node)], out);
  const bool skinned = draw.skin >= 0 && !primitive.influences.empty();
  if (skinned) {
    const SourceSkin& skin = source.skins[static_cast<size_t>(draw.skin)];
    if (state.far_off)
      pose_skinned<double>(draw, skin, state, out);
    else
      pose_skinned<float>(draw, skin, state, out);
  } else {
    const glm::dmat4& world = state.world[static_cast<size_t>(draw.node)];
    const glm::mat4 matrix(world);
    const glm::dmat3 normals = normal_matrix(matrix);
    const double handedness = determinant(matrix);
    for (Vertex& vertex : out) {
      vertex.position = transform_point(world, state.far_off, vertex.position);
      turn_vertex(matrix, normals, handedness, vertex);
    }
  }
  if (primitive.flat && (skinned || !primitive.targets.empty())) redo_flat_normals(draw.mirrored, out);
}

void place_camera(Camera& camera, const NodeState& state) {
  if (camera.node < 0) return;
  const glm::mat4 world(state.world[static_cast<size_t>(camera.node)]);
  const glm::vec3 z = unit_or(glm::vec3(world[2]), {0, 0, 1});
  const glm::vec3 y = orthonormal_tangent(z, glm::vec3(world[1]));
  camera.world_from_camera =
      glm::mat4(glm::vec4(glm::cross(y, z), 0), glm::vec4(y, 0), glm::vec4(z, 0), glm::vec4(glm::vec3(world[3]), 1));
}

void place_light(PunctualLight& light, const NodeState& state) {
  if (light.node < 0) return;
  const glm::mat4 world(state.world[static_cast<size_t>(light.node)]);
  light.position = glm::vec3(world[3]);
  light.direction = unit_or(-glm::vec3(world[2]), {0, 0, -1});
}

Pose pose(const Scene& scene, double time) {
  if (!std::isfinite(time)) throw Error(ExitCode::invalid_input, "the time of a pose is not finite, expected seconds");
  Pose result;
  result.cameras = scene.cameras;
  result.punctual = scene.punctual;
  if (!scene.source) {  // made in code: nothing moves
    result.dynamic_vertices.assign(scene.vertices.begin() + scene.static_vertex_count, scene.vertices.end());
    return result;
  }
  const SceneSource& source = *scene.source;
  const NodeState state = evaluate_nodes(source, time);
  result.dynamic_vertices.resize(scene.vertices.size() - scene.static_vertex_count);
  for (const Draw& draw : source.draws) {
    pose_vertices(source, draw, state,
                  std::span(result.dynamic_vertices).subspan(draw.first_vertex, draw.primitive->vertices.size()));
  }
  for (Camera& camera : result.cameras) place_camera(camera, state);
  for (PunctualLight& light : result.punctual) place_light(light, state);
  return result;
}

}  // namespace lightloom::scene
