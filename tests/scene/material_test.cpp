#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/constants.hpp>

#include "framework/base/error.hpp"
#include "framework/scene/gltf_materials.hpp"
#include "framework/scene/images.hpp"
#include "tests/scene/gltf_builder.hpp"

namespace lightloom::scene {
namespace {

using test::GltfBuilder;
using test::make_png;
using test::to_base64;

void add_image(GltfBuilder& builder, const std::vector<uint8_t>& png) {
  const int image = builder.append("images", {{"uri", "data:image/png;base64," + to_base64(png)}});
  builder.append("textures", {{"source", image}});
}

const std::vector<uint8_t> kRedGreen = make_png(2, 1, 8, 2, {255, 0, 0, 0, 255, 0});

TEST(Material, DefaultsAreThoseOfGltf) {
  GltfBuilder builder;
  builder.append("materials", nlohmann::json::object());
  builder.node({{"mesh", builder.quad(0)}});
  const Scene scene = builder.load();
  const Material& material = scene.materials[0];
  EXPECT_EQ(material.base_color, glm::vec4(1));
  EXPECT_EQ(material.metallic, 1);
  EXPECT_EQ(material.roughness, 1);
  EXPECT_EQ(material.alpha_mode, AlphaMode::opaque);
  EXPECT_FALSE(material.double_sided);
  EXPECT_TRUE(scene.features.metallic);
  EXPECT_FALSE(scene.features.textured);
}

TEST(Material, ReadsEveryExtension) {
  GltfBuilder builder;
  add_image(builder, kRedGreen);
  builder.append("materials", nlohmann::json::parse(R"({
    "name": "brushed", "emissiveFactor": [1, 0.5, 0.25], "doubleSided": true, "alphaMode": "MASK", "alphaCutoff": 0.25,
    "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.5, "roughnessFactor": 0.25},
    "normalTexture": {"index": 0, "scale": 0.75},
    "extensions": {
      "KHR_materials_anisotropy": {"anisotropyStrength": 0.6, "anisotropyRotation": 1.5, "anisotropyTexture": {"index": 0, "texCoord": 1}},
      "KHR_materials_emissive_strength": {"emissiveStrength": 8},
      "KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [1, 2, 3], "specularTexture": {"index": 0}, "specularColorTexture": {"index": 0}},
      "KHR_materials_ior": {"ior": 1.25}, "KHR_materials_unlit": {}}})"));
  builder.node({{"mesh", builder.quad(0)}});
  const Material material = builder.load().materials[0];
  EXPECT_EQ(material.base_color, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
  EXPECT_EQ(material.emission, glm::vec3(8, 4, 2));
  EXPECT_EQ(material.metallic, 0.5f);
  EXPECT_EQ(material.roughness, 0.25f);
  EXPECT_EQ(material.normal_scale, 0.75f);
  EXPECT_EQ(material.anisotropy_strength, 0.6f);
  EXPECT_EQ(material.anisotropy_rotation, 1.5f);
  EXPECT_EQ(material.anisotropy_texture.texcoord, 1u);
  EXPECT_EQ(material.specular_factor, 0.5f);
  EXPECT_EQ(material.specular_color, glm::vec3(1, 2, 3));
  EXPECT_EQ(material.specular_texture.image, 0);
  EXPECT_EQ(material.specular_color_texture.image, 0);
  EXPECT_EQ(material.ior, 1.25f);
  EXPECT_TRUE(material.unlit);
  EXPECT_TRUE(material.double_sided);
  EXPECT_EQ(material.alpha_mode, AlphaMode::mask);
  EXPECT_EQ(material.alpha_cutoff, 0.25f);
}

TEST(Material, DielectricF0) {
  EXPECT_NEAR(dielectric_f0(1.5f), 0.04f, 1e-6);
  EXPECT_EQ(dielectric_f0(1.0f), 0.0f);
  EXPECT_EQ(dielectric_f0(0.0f), 1.0f);
}

TEST(Material, TextureTransformScalesThenRotatesThenMoves) {
  GltfBuilder builder;
  add_image(builder, kRedGreen);
  builder.json["extensionsRequired"] = {"KHR_texture_transform"};
  builder.append("samplers", {{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}});
  builder.json["textures"][0]["sampler"] = 0;
  builder.append("materials", {{"pbrMetallicRoughness",
                                {{"baseColorTexture",
                                  {{"index", 0},
                                   {"extensions",
                                    {{"KHR_texture_transform",
                                      {{"offset", {0.5, 0.25}},
                                       {"rotation", glm::half_pi<double>()},
                                       {"scale", {2, 3}},
                                       {"texCoord", 1}}}}}}}}}});
  builder.node({{"mesh", builder.quad(0)}});
  const TextureUse use = builder.load().materials[0].base_color_texture;
  // A quarter turn counter-clockwise with v pointing down takes +u to -v and +v to +u.
  const glm::vec2 u = use.linear_transform * glm::vec2(1, 0) + use.offset,
                  v = use.linear_transform * glm::vec2(0, 1) + use.offset;
  EXPECT_NEAR(glm::distance(u, glm::vec2(0.5f, 0.25f - 2)), 0, 1e-6);
  EXPECT_NEAR(glm::distance(v, glm::vec2(0.5f + 3, 0.25f)), 0, 1e-6);
  EXPECT_EQ(use.texcoord, 1u);
  EXPECT_EQ(use.wrap_u, Wrap::clamp);
  EXPECT_EQ(use.wrap_v, Wrap::mirror);
  EXPECT_TRUE(use.nearest);
}

TEST(Material, BlendIsMaskedWithAWarning) {
  GltfBuilder builder;
  builder.append("materials", {{"alphaMode", "BLEND"}, {"name", "glass"}});
  builder.node({{"mesh", builder.quad(0)}});
  const Scene scene = builder.load();
  EXPECT_EQ(scene.materials[0].alpha_cutoff, 0.5f);
  EXPECT_TRUE(scene.features.alpha);
  EXPECT_TRUE(std::any_of(scene.warnings.begin(), scene.warnings.end(), [](const std::string& w) {
    return w.find("(glass) has alphaMode BLEND") != std::string::npos;
  }));
}

TEST(Material, OnlyUsedMaterialsMakeFeatures) {
  GltfBuilder builder;
  builder.append("materials", {{"pbrMetallicRoughness", {{"metallicFactor", 0}}}});
  builder.append("materials", {{"emissiveFactor", {1, 1, 1}}, {"alphaMode", "MASK"}});
  builder.node({{"mesh", builder.quad(0)}});
  const Scene scene = builder.load();
  EXPECT_FALSE(scene.features.emissive);
  EXPECT_FALSE(scene.features.alpha);
  EXPECT_FALSE(scene.features.metallic);
}

TEST(Material, BlackEmissiveTextureDoesNotEmit) {
  for (const uint8_t level : {uint8_t{0}, uint8_t{1}}) {
    GltfBuilder builder;
    add_image(builder, make_png(1, 1, 8, 2, {level, 0, 0}));
    builder.append("materials", {{"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", {{"index", 0}}}});
    builder.node({{"mesh", builder.quad(0)}});
    EXPECT_EQ(builder.load().features.emissive, level != 0);
  }
}

struct PngCase {
  const char* name;
  int bit_depth, color_type;
  std::vector<uint8_t> row;  ///< two texels
  std::vector<uint8_t> expected_rgba;
};

TEST(Image, EveryPngLayoutBecomesRgba8) {
  const std::vector<PngCase> cases = {
      {"grey", 8, 0, {10, 200}, {10, 10, 10, 255, 200, 200, 200, 255}},
      {"grey 16", 16, 0, {0x80, 0x80, 0xFF, 0xFF}, {128, 128, 128, 255, 255, 255, 255, 255}},
      {"grey alpha", 8, 4, {10, 7, 200, 0}, {10, 10, 10, 7, 200, 200, 200, 0}},
      {"rgb", 8, 2, {1, 2, 3, 4, 5, 6}, {1, 2, 3, 255, 4, 5, 6, 255}},
      {"rgba, not premultiplied", 8, 6, {200, 100, 50, 10, 4, 5, 6, 0}, {200, 100, 50, 10, 4, 5, 6, 0}},
      {"rgb 16", 16, 2, {0, 0, 0x40, 0x40, 0xFF, 0xFF, 0, 0, 0, 0, 0, 0}, {0, 64, 255, 255, 0, 0, 0, 255}},
  };
  for (const PngCase& png : cases) {
    SCOPED_TRACE(png.name);
    const Image image = decode_image(make_png(2, 1, png.bit_depth, png.color_type, png.row), "test", "image");
    EXPECT_EQ(image.width, 2u);
    EXPECT_EQ(image.height, 1u);
    EXPECT_EQ(image.rgba, png.expected_rgba);
  }
}

TEST(Image, ColourUseIsMarked) {
  GltfBuilder builder;
  add_image(builder, kRedGreen);
  add_image(builder, kRedGreen);
  add_image(builder, kRedGreen);
  builder.append("materials", {{"normalTexture", {{"index", 2}}}, {"emissiveTexture", {{"index", 1}}}});
  builder.node({{"mesh", builder.quad(0)}});
  const Scene scene = builder.load();
  ASSERT_EQ(scene.images.size(), 2u) << "the unused image is not loaded";
  EXPECT_FALSE(scene.images[static_cast<size_t>(scene.materials[0].normal_texture.image)].srgb);
  EXPECT_TRUE(scene.images[static_cast<size_t>(scene.materials[0].emissive_texture.image)].srgb);
}

TEST(Image, TruncatedJpegIsAnError) {
  LIGHTLOOM_NEED_SHARED(shared);
  std::ifstream stream(shared / "khronos/CesiumMan/glTF/CesiumMan.jpg", std::ios::binary);
  const std::vector<uint8_t> jpeg((std::istreambuf_iterator<char>(stream)), {});
  EXPECT_EQ(decode_image(jpeg, "f", "i").width, 1024u);
  for (size_t part = 0; part < 100; ++part) {
    const auto size = static_cast<std::ptrdiff_t>(jpeg.size() * part / 100);
    EXPECT_THROW((void)decode_image({jpeg.begin(), jpeg.begin() + size}, "f", "i"), Error) << size;
  }
}

TEST(Image, TruncatedOrForeignContentIsAnError) {
  std::vector<uint8_t> png = make_png(2, 2, 8, 2, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
  for (size_t size = 0; size < png.size(); ++size) {
    EXPECT_THROW((void)decode_image({png.begin(), png.begin() + static_cast<std::ptrdiff_t>(size)}, "f", "i"), Error)
        << size;
  }
  try {
    (void)decode_image({'G', 'I', 'F', '8', '9', 'a'}, "scene.gltf", "images[3] (wall.gif)");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "scene.gltf: images[3] (wall.gif) is not a PNG or JPEG image, expected one of these");
  }
}

TEST(Materials, GlassIsLeftOutAndSaidSo) {
  GltfBuilder builder;
  builder.append("materials", nlohmann::json::parse(R"({"name": "wall"})"));
  builder.append("materials",
                 nlohmann::json::parse(
                     R"({"name": "pane", "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}}})"));
  builder.append(
      "materials",
      nlohmann::json::parse(
          R"({"name": "milk", "extensions": {"KHR_materials_transmission": {"transmissionFactor": 0.25}}})"));
  for (int material = 0; material < 3; ++material) builder.node({{"mesh", builder.quad(material)}});
  const Scene scene = builder.load();
  EXPECT_EQ(scene.triangles.size(), 4u) << "the wall and the milk glass";
  for (const Triangle& triangle : scene.triangles) EXPECT_NE(scene.materials[triangle.material].name, "pane");
  int said = 0;
  for (const std::string& warning : scene.warnings)
    said += warning.find("(pane) transmits light") != std::string::npos ? 1 : 0;
  EXPECT_EQ(said, 1);
}

TEST(Materials, AModelWithoutCameraIsShownUnderASkyAndASunAndAScenesOwnLightIsKept) {
  GltfBuilder model;
  model.node({{"mesh", model.quad()}});
  EXPECT_GT(model.load().environment.radiance.x, 0);
  EXPECT_TRUE(model.load().sun);

  GltfBuilder lit;
  lit.append("materials", nlohmann::json::parse(R"({"emissiveFactor": [1, 1, 1]})"));
  lit.append("cameras", nlohmann::json::parse(R"({"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}})"));
  lit.node({{"mesh", lit.quad(0)}});
  lit.node({{"camera", 0}});
  EXPECT_EQ(lit.load().environment.radiance, glm::vec3(0));
  EXPECT_FALSE(lit.load().sun);
}

}  // namespace
}  // namespace lightloom::scene
