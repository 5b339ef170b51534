#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "framework/scene/primitive.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::scene {

/// A node at rest. Nodes of all files of a scene lie in one list, parents before children.
struct SourceNode {
  int32_t parent = -1;
  glm::dvec3 translation{0};  ///< in double, as scenes may lie far off
  glm::quat rotation{1, 0, 0, 0};
  glm::vec3 scale{1};
  std::optional<glm::dmat4> matrix;  ///< instead of translation, rotation and scale
  std::vector<float> weights;        ///< of morph targets
  bool moves = false;                ///< it or an ancestor is animated
};

enum class TrackPath : uint8_t { translation, rotation, scale, weights };
enum class Interpolation : uint8_t { step, linear, cubic };

/// How one property of a node changes. `values` holds `width` numbers a key; with cubic interpolation an in-tangent, a
/// value and an out-tangent of `width` numbers each.
struct Track {
  int32_t node = 0;
  TrackPath path = TrackPath::translation;
  Interpolation interpolation = Interpolation::linear;
  std::vector<float> times;  ///< [s], increasing
  std::vector<float> values;
  size_t width = 0;
};

/// The animation that one instance of a file plays, over and over.
struct Clip {
  std::vector<Track> tracks;
  double duration = 0;     ///< [s], above 0
  double offset = 0;       ///< [s], added to the scene's time
  int32_t first_node = 0;  ///< of the instance, whose nodes stand together; no clip moves nodes of another
  int32_t node_count = 0;
};

struct SourceSkin {
  std::vector<int32_t> joints;  ///< nodes
  std::vector<glm::mat4> inverse_bind;
};

/// A primitive drawn by a node. The file's `default_weights` of the mesh are copied into its node.
struct Draw {
  std::shared_ptr<const Primitive> primitive;
  int32_t node = 0;
  int32_t skin = -1;
  uint32_t material = 0;
  uint32_t object = 0;
  uint32_t first_vertex = 0;  ///< into the dynamic vertices
  bool mirrored = false;      ///< its transform turns triangles inside out, which their corner order makes up for
};

/// What posing needs.
struct SceneSource {
  glm::dvec3 origin{0};  ///< Scene::origin
  std::vector<SourceNode> nodes;
  std::vector<Clip> clips;
  std::vector<SourceSkin> skins;
  std::vector<Draw> draws;  ///< those that move; the others are baked
};

/// What one instance with an animation is made of: its nodes, its clip, and what moves of it. It poses as it does in
/// the whole.
[[nodiscard]] SceneSource part_of_clip(const SceneSource& source, const Clip& clip);

/// Transforms of all nodes at one moment.
struct NodeState {
  /// World less the scene's origin, from node. Composed in floats, so exact as such, unless `far_off`.
  std::vector<glm::dmat4> world;
  bool far_off = false;                     ///< the scene's origin is not the world's
  std::vector<std::vector<float>> weights;  ///< of morph targets, by node
};

/// Value of a track at `time` [s] of its clip, clamped to its first and last key (glTF 2.0, appendix C).
[[nodiscard]] std::vector<float> sample_track(const Track& track, double time);

/// Sets the property of `node` that `track` drives.
void apply_track_value(const Track& track, const std::vector<float>& value, SourceNode& node);

/// Time within a clip: (time + offset) modulo its duration, never negative.
[[nodiscard]] double clip_time(const Clip& clip, double time);

/// Nodes at `time` [s].
[[nodiscard]] NodeState evaluate_nodes(const SceneSource& source, double time);

/// World from node at time 0, composed in double; the scene's origin is not subtracted.
[[nodiscard]] std::vector<glm::dmat4> world_from_nodes(const SceneSource& source);

/// Vertices of a draw, in world space less the scene's origin: morphed, then skinned or moved with its node. `out` has
/// as many as the primitive.
void pose_vertices(const SceneSource& source, const Draw& draw, const NodeState& state, std::span<Vertex> out);

/// Whether the transform of a draw turns it inside out.
[[nodiscard]] bool is_mirrored(const SceneSource& source, const Draw& draw, const NodeState& state);

/// Camera and light carried by a node, moved to where the node is.
void place_camera(Camera& camera, const NodeState& state);
void place_light(PunctualLight& light, const NodeState& state);

}  // namespace lightloom::scene
