#include "framework/scene/gltf_materials.hpp"

#include <cmath>

#include "framework/scene/fail.hpp"

namespace lightloom::scene {
namespace {

using tinygltf::Value;

const Value* member(const Value& object, const std::string& key) {
  return object.Has(key) ? &object.Get(key) : nullptr;
}

const Value* extension(const tinygltf::ExtensionMap& extensions, const std::string& name) {
  const auto found = extensions.find(name);
  return found == extensions.end() ? nullptr : &found->second;
}

float number_or(const Value& object, const std::string& key, float fallback) {
  const Value* value = member(object, key);
  return value ? static_cast<float>(value->GetNumberAsDouble()) : fallback;
}

glm::vec3 vec3_or(const Value& object, const std::string& key, const glm::vec3& fallback) {
  const Value* value = member(object, key);
  if (!value || value->ArrayLen() != 3) return fallback;
  const auto part = [&](int i) { return static_cast<float>(value->Get(i).GetNumberAsDouble()); };
  return {part(0), part(1), part(2)};
}

Wrap wrap_of(int gltf) {
  return gltf == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? Wrap::clamp
         : gltf == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror
                                                         : Wrap::repeat;
}

/// Reads the materials of one file.
class MaterialReader {
 public:
  MaterialReader(const GltfFile& file, std::vector<std::string>& warnings) : file_(file), warnings_(warnings) {}

  Material read(size_t index) {
    const tinygltf::Material& source = file_.model.materials[index];
    path_ = "materials[" + std::to_string(index) + "]";
    Material material;
    material.name = source.name.empty() ? path_ : source.name;
    read_core(source, material);
    read_alpha(source, material);
    read_extensions(source, material);
    return material;
  }

 private:
  void read_core(const tinygltf::Material& source, Material& material) {
    const auto& pbr = source.pbrMetallicRoughness;
    for (int k = 0; k < 4; ++k)
      material.base_color[k] = static_cast<float>(pbr.baseColorFactor[static_cast<size_t>(k)]);
    for (int k = 0; k < 3; ++k)
      material.emission[k] = static_cast<float>(source.emissiveFactor[static_cast<size_t>(k)]);
    material.metallic = static_cast<float>(pbr.metallicFactor);
    material.roughness = static_cast<float>(pbr.roughnessFactor);
    material.normal_scale = static_cast<float>(source.normalTexture.scale);
    material.double_sided = source.doubleSided;
    material.base_color_texture = texture(pbr.baseColorTexture, ".pbrMetallicRoughness.baseColorTexture");
    material.metallic_roughness_texture =
        texture(pbr.metallicRoughnessTexture, ".pbrMetallicRoughness.metallicRoughnessTexture");
    material.normal_texture = texture(source.normalTexture, ".normalTexture");
    material.emissive_texture = texture(source.emissiveTexture, ".emissiveTexture");
  }

  void read_alpha(const tinygltf::Material& source, Material& material) {
    if (source.alphaMode == "OPAQUE") return;
    material.alpha_mode = AlphaMode::mask;
    material.alpha_cutoff = source.alphaMode == "MASK" ? static_cast<float>(source.alphaCutoff) : 0.5f;
    if (source.alphaMode == "BLEND") {
      warnings_.push_back(file_.name + ": " + path_ + " (" + material.name +
                          ") has alphaMode BLEND, which is drawn as MASK with cutoff 0.5");
    }
  }

  void read_extensions(const tinygltf::Material& source, Material& material) {
    material.unlit = extension(source.extensions, "KHR_materials_unlit") != nullptr;
    if (const Value* emissive = extension(source.extensions, "KHR_materials_emissive_strength")) {
      material.emission *= number_or(*emissive, "emissiveStrength", 1);
    }
    if (const Value* ior = extension(source.extensions, "KHR_materials_ior")) {
      material.ior = number_or(*ior, "ior", 1.5f);
      if (material.ior != 0 && material.ior < 1)
        fail(file_.name, path_ + ".extensions.KHR_materials_ior.ior",
             "is " + std::to_string(material.ior) + ", expected 0 or a value of at least 1");
    }
    if (const Value* specular = extension(source.extensions, "KHR_materials_specular")) {
      material.specular_factor = number_or(*specular, "specularFactor", 1);
      material.specular_color = vec3_or(*specular, "specularColorFactor", glm::vec3(1));
      material.specular_texture = texture(*specular, "specularTexture");
      material.specular_color_texture = texture(*specular, "specularColorTexture");
    }
    if (const Value* transmission = extension(source.extensions, "KHR_materials_transmission")) {
      material.transmission = number_or(*transmission, "transmissionFactor", 0);
      if (transmits(material)) {
        warnings_.push_back(
            file_.name + ": " + path_ + " (" + material.name +
            ") transmits light (KHR_materials_transmission); its surfaces are left out, as if it did not "
            "refract");
      }
    }
    if (const Value* anisotropy = extension(source.extensions, "KHR_materials_anisotropy")) {
      material.anisotropy_strength = number_or(*anisotropy, "anisotropyStrength", 0);
      material.anisotropy_rotation = number_or(*anisotropy, "anisotropyRotation", 0);
      material.anisotropy_texture = texture(*anisotropy, "anisotropyTexture");
    }
  }

  template <typename Info>
  TextureUse texture(const Info& info, const std::string& name) {
    return info.index < 0
               ? TextureUse{}
               : use(info.index, info.texCoord, extension(info.extensions, "KHR_texture_transform"), path_ + name);
  }

  TextureUse texture(const Value& parent, const std::string& name) {
    const Value* info = member(parent, name);
    if (!info) return {};
    const Value* extensions = member(*info, "extensions");
    const Value* transform = extensions ? member(*extensions, "KHR_texture_transform") : nullptr;
    const Value* texcoord = member(*info, "texCoord");
    return use(info->Get("index").GetNumberAsInt(), texcoord ? texcoord->GetNumberAsInt() : 0, transform,
               path_ + "." + name);
  }

  TextureUse use(int index, int texcoord, const Value* transform, const std::string& path) {
    const tinygltf::Texture& source = file_.model.textures[static_cast<size_t>(index)];
    TextureUse result;
    if (source.source < 0) {
      warnings_.push_back(file_.name + ": textures[" + std::to_string(index) + "] of " + path +
                          " has no source image and is ignored");
      return result;
    }
    result.image = source.source;
    if (source.sampler >= 0) {
      const tinygltf::Sampler& sampler = file_.model.samplers[static_cast<size_t>(source.sampler)];
      result.wrap_u = wrap_of(sampler.wrapS);
      result.wrap_v = wrap_of(sampler.wrapT);
      result.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    }
    if (transform) read_transform(*transform, texcoord, result);
    if (texcoord > 1)
      fail(file_.name, path + ".texCoord", "is " + std::to_string(texcoord) + ", expected 0 or 1",
           "only two sets of texture coordinates are supported");
    result.texcoord = static_cast<uint32_t>(texcoord);
    return result;
  }

  // uv' = offset + rotation * scale * uv, with a rotation that is counter-clockwise as seen with v pointing down.
  static void read_transform(const Value& transform, int& texcoord, TextureUse& result) {
    const auto pair = [&](const std::string& key, float fallback) {
      const Value* value = member(transform, key);
      if (!value || value->ArrayLen() != 2) return glm::vec2(fallback);
      return glm::vec2(value->Get(0).GetNumberAsDouble(), value->Get(1).GetNumberAsDouble());
    };
    const float rotation = number_or(transform, "rotation", 0);
    const glm::vec2 scale = pair("scale", 1);
    const float c = std::cos(rotation), s = std::sin(rotation);
    result.offset = pair("offset", 0);
    result.linear_transform = glm::mat2(glm::vec2(c, -s) * scale.x, glm::vec2(s, c) * scale.y);
    if (const Value* value = member(transform, "texCoord")) texcoord = value->GetNumberAsInt();
  }

  const GltfFile& file_;
  std::vector<std::string>& warnings_;
  std::string path_;
};

}  // namespace

std::vector<Material> load_materials(const GltfFile& file, std::vector<std::string>& warnings) {
  MaterialReader reader(file, warnings);
  std::vector<Material> materials;
  for (size_t i = 0; i < file.model.materials.size(); ++i) materials.push_back(reader.read(i));
  return materials;
}

std::vector<TextureUseRef> texture_uses(Material& material) {
  return {{&material.base_color_texture, true},    {&material.metallic_roughness_texture, false},
          {&material.normal_texture, false},       {&material.emissive_texture, true},
          {&material.anisotropy_texture, false},   {&material.specular_texture, false},
          {&material.specular_color_texture, true}};
}

float dielectric_f0(float ior) {
  const float ratio = (ior - 1) / (ior + 1);
  return ratio * ratio;
}

}  // namespace lightloom::scene
