#include "framework/scene/gltf_nodes.hpp"

#include <algorithm>
#include <numeric>
#include <set>

#include "framework/scene/fail.hpp"

namespace lightloom::scene {
namespace {

std::string node_path(int index) {
  return "nodes[" + std::to_string(index) + "]";
}

std::vector<int> find_parents(const GltfFile& file) {
  std::vector<int> parents(file.model.nodes.size(), -1);
  for (size_t i = 0; i < parents.size(); ++i) {
    for (const int child : file.model.nodes[i].children) {
      int& parent = parents[static_cast<size_t>(child)];
      if (parent >= 0) {
        fail(file.name, node_path(static_cast<int>(i)) + ".children",
             "lists node " + std::to_string(child) + ", which is a child of node " + std::to_string(parent) +
                 " already, expected a node without a parent");
      }
      parent = static_cast<int>(i);
    }
  }
  return parents;
}

// Depth-first, without recursion: files with chains of a hundred thousand nodes exist.
std::vector<int> depth_first(const GltfFile& file, const std::vector<int>& roots) {
  std::vector<int> order;
  std::vector<int> stack(roots.rbegin(), roots.rend());
  while (!stack.empty()) {
    const int node = stack.back();
    stack.pop_back();
    order.push_back(node);
    const std::vector<int>& children = file.model.nodes[static_cast<size_t>(node)].children;
    stack.insert(stack.end(), children.rbegin(), children.rend());
  }
  return order;
}

std::vector<int> drawn_roots(const GltfFile& file, const std::vector<int>& roots) {
  if (file.model.scenes.empty()) return roots;
  return file.model.scenes[static_cast<size_t>(std::max(file.model.defaultScene, 0))].nodes;
}

void check_scenes(const GltfFile& file, const std::vector<int>& parents) {
  std::vector<size_t> listed_by(parents.size(), 0);  // one more than the scene; a mark for each would be quadratic
  for (size_t s = 0; s < file.model.scenes.size(); ++s) {
    const std::vector<int>& nodes = file.model.scenes[s].nodes;
    for (const int node : nodes) {
      const std::string path = "scenes[" + std::to_string(s) + "].nodes";
      if (parents[static_cast<size_t>(node)] >= 0) {
        fail(file.name, path,
             "lists node " + std::to_string(node) + ", a child of node " +
                 std::to_string(parents[static_cast<size_t>(node)]) + ", expected root nodes");
      }
      if (listed_by[static_cast<size_t>(node)] == s + 1)
        fail(file.name, path, "lists node " + std::to_string(node) + " twice, expected each node once");
      listed_by[static_cast<size_t>(node)] = s + 1;
    }
  }
}

void require_depth_within(const GltfFile& file, const NodeOrder& nodes, const Limits& limits) {
  std::vector<uint64_t> depths(nodes.parents.size(), 1);
  for (const int node : nodes.order) {
    const int parent = nodes.parents[static_cast<size_t>(node)];
    if (parent >= 0) depths[static_cast<size_t>(node)] = depths[static_cast<size_t>(parent)] + 1;
  }
  const auto deepest = std::max_element(depths.begin(), depths.end());
  if (deepest == depths.end()) return;
  require_within(limits, &Limits::node_depth,
                 file.name + ": " + node_path(static_cast<int>(deepest - depths.begin())) + " with its ancestors",
                 *deepest);
}

glm::vec3 vec3_of(const std::vector<double>& values) {
  return {values[0], values[1], values[2]};
}

size_t track_width(TrackPath path, size_t morph_targets) {
  switch (path) {
    case TrackPath::rotation:
      return 4;
    case TrackPath::weights:
      return morph_targets;
    default:
      return 3;
  }
}

TrackPath path_of(const std::string& name) {
  return name == "translation" ? TrackPath::translation
         : name == "rotation"  ? TrackPath::rotation
         : name == "scale"     ? TrackPath::scale
                               : TrackPath::weights;
}

AccessorRule output_rule(TrackPath path) {
  switch (path) {
    case TrackPath::rotation:
      return {"VEC4", "float i8n u8n i16n u16n"};
    case TrackPath::weights:
      return {"SCALAR", "float i8n u8n i16n u16n"};
    default:
      return {"VEC3", "float"};
  }
}

void check_times(const GltfFile& file, const std::vector<float>& times, const std::string& path) {
  for (size_t i = 0; i < times.size(); ++i) {
    if (times[i] < 0 || (i > 0 && times[i] <= times[i - 1])) {
      fail(file.name, path,
           "has the time " + std::to_string(times[i]) + " at place " + std::to_string(i) +
               ", expected increasing times of at least 0");
    }
  }
}

Track load_track(const GltfFile& file, const AccessorReader& reader, const tinygltf::AnimationSampler& sampler,
                 const tinygltf::AnimationChannel& channel, size_t morph_targets, const std::string& path) {
  Track track;
  track.node = channel.target_node;
  track.path = path_of(channel.target_path);
  track.interpolation = sampler.interpolation == "STEP"          ? Interpolation::step
                        : sampler.interpolation == "CUBICSPLINE" ? Interpolation::cubic
                                                                 : Interpolation::linear;
  track.width = track_width(track.path, morph_targets);
  track.times = reader.floats(sampler.input, {"SCALAR", "float"}, path + ".input").values;
  check_times(file, track.times, path + ".input");
  AccessorValues output = reader.floats(sampler.output, output_rule(track.path), path + ".output");
  const size_t group = track.interpolation == Interpolation::cubic ? 3 : 1;
  const size_t expected = track.times.size() * track.width * group;
  if (output.values.size() != expected) {
    fail(file.name, path + ".output",
         "holds " + std::to_string(output.count) + " elements, expected " + std::to_string(expected / output.width) +
             " for " + std::to_string(track.times.size()) + " keys of " + channel.target_path);
  }
  track.values = std::move(output.values);
  return track;
}

}  // namespace

NodeOrder order_nodes(const GltfFile& file, const Limits& limits) {
  NodeOrder result;
  result.parents = find_parents(file);
  std::vector<int> roots;
  for (size_t i = 0; i < result.parents.size(); ++i) {
    if (result.parents[i] < 0) roots.push_back(static_cast<int>(i));
  }
  result.order = depth_first(file, roots);
  if (result.order.size() != result.parents.size()) {
    std::vector<bool> reached(result.parents.size(), false);
    for (const int node : result.order) reached[static_cast<size_t>(node)] = true;
    const auto lost = std::find(reached.begin(), reached.end(), false) - reached.begin();
    fail(file.name, node_path(static_cast<int>(lost)),
         "is its own descendant or hangs below a node that is, expected a tree of nodes");
  }
  require_depth_within(file, result, limits);
  check_scenes(file, result.parents);
  result.drawn = depth_first(file, drawn_roots(file, roots));
  return result;
}

SourceNode load_node(const GltfFile& file, int index) {
  const tinygltf::Node& source = file.model.nodes[static_cast<size_t>(index)];
  SourceNode node;
  if (!source.matrix.empty()) {
    glm::dmat4 matrix;
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = source.matrix[static_cast<size_t>(i)];
    if (const glm::mat4 rounded(matrix);
        rounded[0].w != 0 || rounded[1].w != 0 || rounded[2].w != 0 || rounded[3].w != 1) {
      fail(file.name, node_path(index) + ".matrix", "is not an affine transform, expected the bottom row 0 0 0 1");
    }
    node.matrix = matrix;
  }
  if (!source.translation.empty())
    node.translation = {source.translation[0], source.translation[1], source.translation[2]};
  if (!source.scale.empty()) node.scale = vec3_of(source.scale);
  if (!source.rotation.empty()) {
    const glm::dquat q(source.rotation[3], source.rotation[0], source.rotation[1], source.rotation[2]);
    const double length = glm::length(q);
    if (!(length > 1e-6)) fail(file.name, node_path(index) + ".rotation", "is zero, expected a unit quaternion");
    node.rotation = glm::quat(q / length);
  }
  return node;
}

SourceSkin load_skin(const GltfFile& file, const AccessorReader& reader, int index) {
  const tinygltf::Skin& source = file.model.skins[static_cast<size_t>(index)];
  const std::string path = "skins[" + std::to_string(index) + "]";
  SourceSkin skin;
  skin.joints.assign(source.joints.begin(), source.joints.end());
  skin.inverse_bind.assign(skin.joints.size(), glm::mat4(1));
  if (source.inverseBindMatrices < 0) return skin;
  const AccessorValues values =
      reader.floats(source.inverseBindMatrices, {"MAT4", "float"}, path + ".inverseBindMatrices");
  if (values.count < skin.joints.size()) {
    fail(file.name, path + ".inverseBindMatrices",
         "has " + std::to_string(values.count) + " matrices, expected one for each of the " +
             std::to_string(skin.joints.size()) + " joints");
  }
  for (size_t j = 0; j < skin.joints.size(); ++j) {
    for (int k = 0; k < 16; ++k) skin.inverse_bind[j][k / 4][k % 4] = values.values[j * 16 + static_cast<size_t>(k)];
  }
  return skin;
}

std::vector<size_t> count_morph_targets(const GltfFile& file) {
  std::vector<size_t> counts;
  for (size_t m = 0; m < file.model.meshes.size(); ++m) {
    const tinygltf::Mesh& mesh = file.model.meshes[m];
    const std::string path = "meshes[" + std::to_string(m) + "]";
    const size_t count = mesh.primitives.front().targets.size();
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      if (primitive.targets.size() != count)
        fail(file.name, path, "has primitives with different numbers of morph targets, expected equal numbers");
    }
    if (!mesh.weights.empty() && mesh.weights.size() != count) {
      fail(file.name, path + ".weights",
           "has " + std::to_string(mesh.weights.size()) + " numbers, expected " + std::to_string(count) +
               ", one for each morph target");
    }
    counts.push_back(count);
  }
  return counts;
}

Clip load_animation(const GltfFile& file, const AccessorReader& reader, const std::vector<size_t>& morph_targets,
                    int index) {
  const tinygltf::Animation& source = file.model.animations[static_cast<size_t>(index)];
  const std::string path = "animations[" + std::to_string(index) + "]";
  Clip clip;
  std::set<std::pair<int, TrackPath>> targets;
  for (size_t c = 0; c < source.channels.size(); ++c) {
    const tinygltf::AnimationChannel& channel = source.channels[c];
    const std::string channel_path = path + ".channels[" + std::to_string(c) + "]";
    if (channel.sampler < 0 || static_cast<size_t>(channel.sampler) >= source.samplers.size()) {
      fail(file.name, channel_path + ".sampler",
           "is " + std::to_string(channel.sampler) + ", expected an index into samplers, which has " +
               std::to_string(source.samplers.size()) + " elements");
    }
    if (channel.target_node < 0) continue;
    const tinygltf::Node& node = file.model.nodes[static_cast<size_t>(channel.target_node)];
    const bool weights = channel.target_path == "weights";
    const size_t targets_of_node = node.mesh >= 0 ? morph_targets[static_cast<size_t>(node.mesh)] : 0;
    if (weights && targets_of_node == 0)
      fail(file.name, channel_path + ".target",
           "animates weights of node " + std::to_string(channel.target_node) +
               ", expected a node whose mesh has morph targets");
    if (!weights && !node.matrix.empty())
      fail(file.name, channel_path + ".target",
           "animates node " + std::to_string(channel.target_node) +
               ", which has a matrix, expected translation, rotation and scale");
    const std::string sampler_path = path + ".samplers[" + std::to_string(channel.sampler) + "]";
    Track track = load_track(file, reader, source.samplers[static_cast<size_t>(channel.sampler)], channel,
                             targets_of_node, sampler_path);
    if (!targets.emplace(track.node, track.path).second) {
      fail(file.name, channel_path + ".target", "is animated by an earlier channel, expected each property once");
    }
    clip.duration = std::max(clip.duration, static_cast<double>(track.times.back()));
    clip.tracks.push_back(std::move(track));
  }
  return clip;
}

bool is_constant(const Track& track) {
  if (track.times.size() < 2) return true;
  const size_t group = track.interpolation == Interpolation::cubic ? 3 : 1;
  for (size_t i = 0; i < track.values.size(); ++i) {
    const size_t part = i / track.width % group;
    const bool is_value = group == 1 || part == 1;
    const float expected = is_value ? track.values[(group / 2) * track.width + i % track.width] : 0.0f;
    if (track.values[i] != expected) return false;
  }
  return true;
}

}  // namespace lightloom::scene
