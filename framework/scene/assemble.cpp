#include "framework/scene/assemble.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>

#include "framework/base/text.hpp"
#include "framework/scene/basis.hpp"
#include "framework/scene/fail.hpp"
#include "framework/scene/gltf_materials.hpp"
#include "framework/scene/input_context.hpp"
#include "framework/scene/origin.hpp"

namespace lightloom::scene {
namespace {

constexpr float kMaxCoordinate = 1e15f;  ///< squares of differences must stay finite in single precision

/// An asset and where its materials start in the scene.
struct PlacedAsset {
  std::unique_ptr<GltfAsset> asset;
  uint32_t first_material = 0;
};

class Assembler {
 public:
  Assembler(const std::filesystem::path& path, const LoadOptions& options)
      : context_(path, options), source_(std::make_shared<SceneSource>()) {
    scene_.file = path;
  }

  Scene build(const SceneFile& file) {
    for (const CameraSpec& camera : file.cameras) scene_.cameras.push_back(camera.camera);
    scene_.sun = file.sun;
    scene_.environment = file.environment;
    for (size_t i = 0; i < file.instances.size(); ++i) add_instance(file.instances[i], i == 0);
    mark_moving_nodes();
    scene_.origin = source_->origin = choose_origin(*source_, draws_);
    for (size_t i = 0; i < file.cameras.size(); ++i)
      scene_.cameras[i].world_from_camera = look_at_target(file.cameras[i], scene_.origin);
    place_draws();
    name_cameras();
    scene_.source = source_;
    return std::move(scene_);
  }

 private:
  PlacedAsset& placed(const InstanceSpec& instance) {
    const std::string key = std::filesystem::weakly_canonical(instance.gltf).string();
    const auto found = assets_.find(key);
    if (found != assets_.end()) return found->second;
    PlacedAsset& result = assets_[key];
    try {
      result.asset = std::make_unique<GltfAsset>(load_asset(instance.gltf, context_));
    } catch (const Error& error) {
      if (instance.where.empty()) throw;
      throw Error(error.code(), instance.where + ": " + error.what(), error.hint());
    }
    add_materials(*result.asset, result.first_material);
    return result;
  }

  void add_materials(GltfAsset& asset, uint32_t& first_material) {
    first_material = static_cast<uint32_t>(scene_.materials.size());
    const auto first_image = static_cast<int32_t>(scene_.images.size());
    for (Material material : asset.materials) {
      for (const TextureUseRef& ref : texture_uses(material)) {
        if (ref.use->image >= 0) ref.use->image += first_image;
      }
      scene_.materials.push_back(std::move(material));
    }
    std::move(asset.images.begin(), asset.images.end(), std::back_inserter(scene_.images));
    asset.images.clear();
    scene_.warnings.insert(scene_.warnings.end(), asset.warnings.begin(), asset.warnings.end());
  }

  uint32_t material_index(const PlacedAsset& placed_asset, int material) {
    if (material >= 0) return placed_asset.first_material + static_cast<uint32_t>(material);
    if (!default_material_) {
      default_material_ = static_cast<uint32_t>(scene_.materials.size());
      scene_.materials.emplace_back().name = "default";
    }
    return *default_material_;
  }

  /// What an instance adds to the lists of all instances.
  void require_instance_within(const GltfAsset& asset) {
    const std::string name = "the scene with " + asset.file.name;
    require(&Limits::nodes, name, source_->nodes.size() + asset.nodes.size() + 1);
    for (const SourceNode& node : asset.nodes) morph_weights_ += node.weights.size();
    require(&Limits::morph_weights, name, morph_weights_);
    for (const SourceSkin& skin : asset.skins) joints_ += skin.joints.size();
    require(&Limits::joints, name, joints_);
  }

  void require(uint64_t Limits::*limit, const std::string& element, uint64_t claimed) const {
    require_within(context_.limits(), limit, scene_.file.string() + ": " + element, claimed);
  }

  void add_instance(const InstanceSpec& instance, bool is_main) {
    const PlacedAsset& found = placed(instance);
    const GltfAsset& asset = *found.asset;
    require_instance_within(asset);
    SourceNode root;
    root.translation = instance.translation;
    root.rotation = glm::angleAxis(instance.rotation_y, glm::vec3(0, 1, 0));
    root.scale = glm::vec3(instance.scale);
    const auto root_index = static_cast<int32_t>(source_->nodes.size());
    source_->nodes.push_back(root);

    std::vector<int32_t> global(asset.nodes.size());
    for (const int node : asset.order.order) {
      const auto n = static_cast<size_t>(node);
      global[n] = static_cast<int32_t>(source_->nodes.size());
      source_->nodes.push_back(asset.nodes[n]);
      const int parent = asset.order.parents[n];
      source_->nodes.back().parent = parent < 0 ? root_index : global[static_cast<size_t>(parent)];
    }
    const auto first_skin = static_cast<int32_t>(source_->skins.size());
    for (SourceSkin skin : asset.skins) {
      for (int32_t& joint : skin.joints) joint = global[static_cast<size_t>(joint)];
      source_->skins.push_back(std::move(skin));
    }
    add_clip(instance, asset, global);
    for (const int node : asset.order.drawn)
      add_drawn_node(found, node, global[static_cast<size_t>(node)], first_skin, is_main);
  }

  void add_drawn_node(const PlacedAsset& found, int node, int32_t global, int32_t first_skin, bool is_main) {
    const GltfAsset& asset = *found.asset;
    const tinygltf::Node& source = asset.file.model.nodes[static_cast<size_t>(node)];
    if (source.mesh >= 0) {
      const std::string& mesh_name = asset.file.model.meshes[static_cast<size_t>(source.mesh)].name;
      const auto object = static_cast<uint32_t>(scene_.objects.size());
      scene_.objects.push_back(!source.name.empty() ? source.name
                               : !mesh_name.empty() ? mesh_name
                                                    : "object " + std::to_string(object));
      for (const auto& primitive : asset.meshes[static_cast<size_t>(source.mesh)]) {
        if (primitive->dropped_triangles > 0) dropped_ += primitive->dropped_triangles;
        if (primitive->indices.empty()) continue;
        Draw draw;
        draw.primitive = primitive;
        draw.node = global;
        draw.skin = source.skin < 0 ? -1 : first_skin + source.skin;
        draw.material = material_index(found, primitive->material);
        draw.object = object;
        if (transmits(scene_.materials[draw.material])) continue;
        if (source.skin >= 0) joints_ += asset.skins[static_cast<size_t>(source.skin)].joints.size();
        require(&Limits::joints, "with nodes[" + std::to_string(node) + "] the scene", joints_);
        draws_.push_back(std::move(draw));
      }
    }
    if (source.camera >= 0 && is_main) {
      Camera camera = load_camera(asset.file, source.camera);
      if (!source.name.empty()) camera.name = source.name;
      camera.node = global;
      scene_.cameras.push_back(camera);
    }
    const auto light = source.extensions.find("KHR_lights_punctual");
    if (light != source.extensions.end() && light->second.Has("light")) {
      PunctualLight punctual = load_light(asset.file, light->second.Get("light").GetNumberAsInt());
      if (punctual.name.empty()) punctual.name = source.name;
      punctual.node = global;
      scene_.punctual.push_back(punctual);
    }
  }

  int choose_animation(const InstanceSpec& instance, const GltfAsset& asset) const {
    const std::vector<tinygltf::Animation>& animations = asset.file.model.animations;
    if (const int* index = std::get_if<int>(&instance.animation)) {
      if (static_cast<size_t>(*index) < animations.size()) return *index;
      if (!instance.animation_named) return -1;
      throw Error(ExitCode::invalid_input, instance.where + ".animation is " + std::to_string(*index) + ", but " +
                                               asset.file.name + " has " + std::to_string(animations.size()) +
                                               " animations");
    }
    const std::string& wanted = std::get<std::string>(instance.animation);
    std::vector<std::string> names;
    for (size_t i = 0; i < animations.size(); ++i) {
      if (animations[i].name == wanted) return static_cast<int>(i);
      names.push_back(animations[i].name);
    }
    throw Error(ExitCode::invalid_input,
                instance.where + ".animation is " + in_quotes(wanted) + ", which " + asset.file.name + " does not have",
                did_you_mean(wanted, names, "it has"));
  }

  void add_clip(const InstanceSpec& instance, const GltfAsset& asset, const std::vector<int32_t>& global) {
    const int chosen = choose_animation(instance, asset);
    if (chosen < 0) return;
    Clip clip;
    clip.duration = asset.animations[static_cast<size_t>(chosen)].duration;
    clip.offset = instance.time_offset;
    clip.node_count = static_cast<int32_t>(asset.nodes.size()) + 1;
    clip.first_node = static_cast<int32_t>(source_->nodes.size()) - clip.node_count;
    for (const Track& track : asset.animations[static_cast<size_t>(chosen)].tracks)
      animation_values_ += track.times.size() + track.values.size();
    require(&Limits::animation_values,
            "the scene with animations[" + std::to_string(chosen) + "] of " + asset.file.name, animation_values_);
    for (Track track : asset.animations[static_cast<size_t>(chosen)].tracks) {
      track.node = global[static_cast<size_t>(track.node)];
      SourceNode& node = source_->nodes[static_cast<size_t>(track.node)];
      if (is_constant(track)) {
        apply_track_value(track, sample_track(track, 0), node);
      } else {
        clip.tracks.push_back(std::move(track));
      }
    }
    if (clip.tracks.empty()) return;
    scene_.duration = std::max(scene_.duration, clip.duration);
    source_->clips.push_back(std::move(clip));
  }

  void mark_moving_nodes() {
    deforms_.assign(source_->nodes.size(), false);
    for (const Clip& clip : source_->clips) {
      for (const Track& track : clip.tracks) {
        const auto node = static_cast<size_t>(track.node);
        if (track.path == TrackPath::weights) {
          deforms_[node] = true;
        } else {
          source_->nodes[node].moves = true;
        }
      }
    }
    for (SourceNode& node : source_->nodes) {
      if (node.parent >= 0 && source_->nodes[static_cast<size_t>(node.parent)].moves) node.moves = true;
    }
  }

  [[nodiscard]] bool is_dynamic(const Draw& draw) const {
    const auto node = static_cast<size_t>(draw.node);
    if (deforms_[node] && !draw.primitive->targets.empty()) return true;
    if (draw.skin < 0) return source_->nodes[node].moves;
    const std::vector<int32_t>& joints = source_->skins[static_cast<size_t>(draw.skin)].joints;
    return std::any_of(joints.begin(), joints.end(),
                       [&](int32_t joint) { return source_->nodes[static_cast<size_t>(joint)].moves; });
  }

  void place_draws() {
    uint64_t vertices = 0, triangles = 0;
    for (const Draw& draw : draws_) {
      vertices += draw.primitive->vertices.size();
      triangles += draw.primitive->indices.size() / 3;
    }
    require(&Limits::vertices, "the scene with all instances", vertices);
    require(&Limits::triangles, "the scene with all instances", triangles);
    const NodeState state = evaluate_nodes(*source_, 0);
    for (Draw& draw : draws_) {
      if (!is_dynamic(draw)) add_geometry(draw, state, false);
    }
    scene_.static_vertex_count = static_cast<uint32_t>(scene_.vertices.size());
    scene_.static_triangle_count = static_cast<uint32_t>(scene_.triangles.size());
    for (Draw& draw : draws_) {
      if (!is_dynamic(draw)) continue;
      draw.first_vertex = static_cast<uint32_t>(scene_.vertices.size()) - scene_.static_vertex_count;
      add_geometry(draw, state, true);
      source_->draws.push_back(draw);
    }
    for (Camera& camera : scene_.cameras) place_camera(camera, state);
    for (PunctualLight& light : scene_.punctual) place_light(light, state);
    if (scene_.triangles.empty()) fail(scene_.file.string(), "the scene", "contains no triangles");
    if (dropped_ > 0)
      scene_.warnings.push_back(std::to_string(dropped_) + (dropped_ == 1 ? " degenerate triangle was dropped"
                                                                          : " degenerate triangles were dropped"));
  }

  void add_geometry(Draw& draw, const NodeState& state, bool dynamic) {
    const Primitive& primitive = *draw.primitive;
    const auto first = static_cast<uint32_t>(scene_.vertices.size());
    scene_.vertices.resize(first + primitive.vertices.size());
    const std::span<Vertex> vertices = std::span(scene_.vertices).subspan(first);
    draw.mirrored = is_mirrored(*source_, draw, state);
    pose_vertices(*source_, draw, state, vertices);
    for (const Vertex& vertex : vertices) {
      const glm::vec3 size = glm::abs(vertex.position);
      if (!(size.x <= kMaxCoordinate && size.y <= kMaxCoordinate && size.z <= kMaxCoordinate)) {
        fail(scene_.file.string(), "object '" + scene_.objects[draw.object] + "'",
             "has a vertex farther than 1e15 from the origin in world space, expected a smaller scene");
      }
    }
    for (size_t i = 0; i < primitive.indices.size(); i += 3) {
      const uint32_t a = primitive.indices[i], b = primitive.indices[i + (draw.mirrored ? 2 : 1)],
                     c = primitive.indices[i + (draw.mirrored ? 1 : 2)];
      if (!dynamic && is_degenerate(vertices[a].position, vertices[b].position, vertices[c].position)) {
        ++dropped_;
        continue;
      }
      scene_.triangles.push_back({first + a, first + b, first + c, draw.material, draw.object});
    }
  }

  void name_cameras() {
    std::map<std::string, int> uses;
    for (size_t i = 0; i < scene_.cameras.size(); ++i) {
      Camera& camera = scene_.cameras[i];
      if (camera.name.empty()) camera.name = "camera" + std::to_string(i);
      const int earlier = uses[camera.name]++;
      if (earlier > 0) camera.name += "_" + std::to_string(earlier + 1);
    }
  }

  InputContext context_;
  Scene scene_;
  std::shared_ptr<SceneSource> source_;
  std::map<std::string, PlacedAsset> assets_;
  std::vector<Draw> draws_;
  std::vector<bool> deforms_;  ///< by node: its morph weights are animated
  std::optional<uint32_t> default_material_;
  size_t dropped_ = 0;
  uint64_t morph_weights_ = 0, joints_ = 0, animation_values_ = 0;  ///< of all instances so far
};

}  // namespace

Scene assemble(const std::filesystem::path& path, const SceneFile& file, const LoadOptions& options) {
  return Assembler(path, options).build(file);
}

}  // namespace lightloom::scene
