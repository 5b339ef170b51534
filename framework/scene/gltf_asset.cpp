#include "framework/scene/gltf_asset.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/interrupt.hpp"
#include "framework/scene/accessor.hpp"
#include "framework/scene/fail.hpp"
#include "framework/scene/gltf_materials.hpp"
#include "framework/scene/images.hpp"
#include "framework/scene/input_context.hpp"

namespace lightloom::scene {
namespace {

uint32_t tangent_texcoord(const GltfAsset& asset, int material) {
  if (material < 0) return 0;
  const Material& used = asset.materials[static_cast<size_t>(material)];
  if (used.normal_texture.image >= 0) return used.normal_texture.texcoord;
  return used.anisotropy_texture.image >= 0 ? used.anisotropy_texture.texcoord : 0;
}

void warn_missing_texcoords(GltfAsset& asset, const tinygltf::Primitive& source, const std::string& path) {
  if (source.material < 0) return;
  Material& material = asset.materials[static_cast<size_t>(source.material)];
  for (const TextureUseRef& ref : texture_uses(material)) {
    const std::string name = "TEXCOORD_" + std::to_string(ref.use->texcoord);
    if (ref.use->image >= 0 && !source.attributes.contains(name)) {
      asset.warnings.push_back(asset.file.name + ": " + path + " has no " + name +
                               ", which its material reads; (0, 0) is used");
      return;
    }
  }
}

/// Vertices and triangles of all primitives, as the accessors claim them; nothing is read yet.
void require_geometry_within(const GltfAsset& asset, const AccessorReader& reader, const Limits& limits) {
  uint64_t vertices = 0, triangles = 0;
  for (size_t m = 0; m < asset.file.model.meshes.size(); ++m) {
    for (const tinygltf::Primitive& primitive : asset.file.model.meshes[m].primitives) {
      const auto position = primitive.attributes.find("POSITION");
      if (position == primitive.attributes.end() || primitive.mode < TINYGLTF_MODE_TRIANGLES) continue;
      const size_t corners = reader.count(primitive.indices >= 0 ? primitive.indices : position->second);
      vertices += reader.count(position->second);
      triangles += primitive.mode == TINYGLTF_MODE_TRIANGLES ? corners / 3 : corners;
      const std::string name = asset.file.name + ": with meshes[" + std::to_string(m) + "] the file";
      require_within(limits, &Limits::vertices, name, vertices);
      require_within(limits, &Limits::triangles, name, triangles);
    }
  }
}

void load_meshes(GltfAsset& asset, const AccessorReader& reader) {
  for (size_t m = 0; m < asset.file.model.meshes.size(); ++m) {
    std::vector<std::shared_ptr<const Primitive>>& primitives = asset.meshes.emplace_back();
    const std::vector<tinygltf::Primitive>& sources = asset.file.model.meshes[m].primitives;
    for (size_t p = 0; p < sources.size(); ++p) {
      stop_if_interrupted();
      const std::string path = "meshes[" + std::to_string(m) + "].primitives[" + std::to_string(p) + "]";
      primitives.push_back(std::make_shared<Primitive>(load_primitive(
          reader, asset.file, sources[p], tangent_texcoord(asset, sources[p].material), path, asset.warnings)));
      warn_missing_texcoords(asset, sources[p], path);
    }
  }
}

void check_skinned_node(const GltfAsset& asset, size_t node) {
  const tinygltf::Node& source = asset.file.model.nodes[node];
  if (source.skin < 0 || source.mesh < 0) return;
  const size_t joints = asset.skins[static_cast<size_t>(source.skin)].joints.size();
  for (const auto& primitive : asset.meshes[static_cast<size_t>(source.mesh)]) {
    if (primitive->joint_limit > joints) {
      fail(asset.file.name, "meshes[" + std::to_string(source.mesh) + "]",
           "uses joint " + std::to_string(primitive->joint_limit - 1) + ", expected a joint below " +
               std::to_string(joints) + ", the number of joints of skins[" + std::to_string(source.skin) +
               "] of nodes[" + std::to_string(node) + "]");
    }
    if (primitive->influences.empty() && !primitive->vertices.empty()) {
      fail(asset.file.name, "nodes[" + std::to_string(node) + "].skin",
           "skins mesh " + std::to_string(source.mesh) + ", which has no JOINTS_0 and WEIGHTS_0, expected both");
    }
  }
}

std::vector<float> rest_weights(const GltfAsset& asset, size_t node, const std::vector<size_t>& targets) {
  const tinygltf::Node& source = asset.file.model.nodes[node];
  if (source.mesh < 0) return {};
  const auto mesh = static_cast<size_t>(source.mesh);
  const std::vector<double>& own = source.weights;
  if (!own.empty() && own.size() != targets[mesh]) {
    fail(asset.file.name, "nodes[" + std::to_string(node) + "].weights",
         "has " + std::to_string(own.size()) + " numbers, expected " + std::to_string(targets[mesh]) +
             ", one for each morph target");
  }
  const std::vector<double>& chosen = own.empty() ? asset.file.model.meshes[mesh].weights : own;
  std::vector<float> weights(targets[mesh], 0.0f);
  for (size_t t = 0; t < chosen.size(); ++t) weights[t] = static_cast<float>(chosen[t]);
  return weights;
}

void load_used_images(GltfAsset& asset) {
  std::vector<int> place(asset.file.images.size(), -1);
  std::vector<int> used;
  std::vector<bool> srgb;
  for (Material& material : asset.materials) {
    for (const TextureUseRef& ref : texture_uses(material)) {
      if (ref.use->image < 0) continue;
      int& slot = place[static_cast<size_t>(ref.use->image)];
      if (slot < 0) {
        slot = static_cast<int>(used.size());
        used.push_back(ref.use->image);
        srgb.push_back(false);
      }
      if (ref.srgb) srgb[static_cast<size_t>(slot)] = true;
      ref.use->image = slot;
    }
  }
  asset.images = load_images(asset.file, used);
  for (size_t i = 0; i < used.size(); ++i) asset.images[i].srgb = srgb[i];
}

}  // namespace

GltfAsset load_asset(const std::filesystem::path& path, InputContext& context) {
  GltfAsset asset;
  asset.file = read_gltf_file(path, context);
  asset.warnings = asset.file.warnings;
  const AccessorReader reader(asset.file);
  asset.order = order_nodes(asset.file, context.limits());
  const std::vector<size_t> targets = count_morph_targets(asset.file);
  asset.materials = load_materials(asset.file, asset.warnings);
  require_geometry_within(asset, reader, context.limits());
  load_meshes(asset, reader);
  for (size_t i = 0; i < asset.file.model.skins.size(); ++i)
    asset.skins.push_back(load_skin(asset.file, reader, static_cast<int>(i)));
  uint64_t weights = 0;
  for (size_t i = 0; i < asset.file.model.nodes.size(); ++i) {
    const int mesh = asset.file.model.nodes[i].mesh;
    weights += mesh < 0 ? 0 : targets[static_cast<size_t>(mesh)];
    require_within(context.limits(), &Limits::morph_weights,
                   asset.file.name + ": with nodes[" + std::to_string(i) + "] the file", weights);
    asset.nodes.push_back(load_node(asset.file, static_cast<int>(i)));
    asset.nodes.back().weights = rest_weights(asset, i, targets);
    check_skinned_node(asset, i);
  }
  for (size_t i = 0; i < asset.file.model.animations.size(); ++i)
    asset.animations.push_back(load_animation(asset.file, reader, targets, static_cast<int>(i)));
  load_used_images(asset);
  return asset;
}

Camera load_camera(const GltfFile& file, int index) {
  const tinygltf::Camera& source = file.model.cameras[static_cast<size_t>(index)];
  Camera camera;
  camera.name = source.name;
  camera.perspective = source.type == "perspective";
  if (camera.perspective) {
    camera.vertical_fov = static_cast<float>(source.perspective.yfov);
  } else {
    camera.half_height = std::abs(static_cast<float>(source.orthographic.ymag));
    if (!(camera.half_height > 0))
      fail(file.name, "cameras[" + std::to_string(index) + "].orthographic.ymag",
           "is 0, expected half the height of the view");
  }
  return camera;
}

PunctualLight load_light(const GltfFile& file, int index) {
  const tinygltf::Light& source = file.model.lights[static_cast<size_t>(index)];
  PunctualLight light;
  light.name = source.name;
  light.type = source.type == "point"  ? PunctualType::point
               : source.type == "spot" ? PunctualType::spot
                                       : PunctualType::directional;
  for (int k = 0; k < 3; ++k) {
    const double channel = source.color.size() == 3 ? source.color[static_cast<size_t>(k)] : 1.0;
    light.intensity[k] = static_cast<float>(channel * source.intensity);
  }
  light.range = static_cast<float>(source.range);
  if (light.type == PunctualType::spot) {
    light.inner_cone = static_cast<float>(source.spot.innerConeAngle);
    light.outer_cone = static_cast<float>(source.spot.outerConeAngle);
    if (light.inner_cone >= light.outer_cone) {
      fail(file.name, "extensions.KHR_lights_punctual.lights[" + std::to_string(index) + "].spot.innerConeAngle",
           "is not below outerConeAngle, expected a smaller angle");
    }
  }
  return light;
}

}  // namespace lightloom::scene
