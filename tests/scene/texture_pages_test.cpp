#include "framework/scene/texture_pages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <numeric>
#include <random>
#include <set>

#include "framework/scene/color.hpp"
#include "framework/scene/gpu_material.hpp"
#include "tests/scene/gltf_builder.hpp"

namespace lightloom::scene {
namespace {

Image make_image(uint32_t width, uint32_t height, const std::array<uint8_t, 4>& texel) {
  Image image;
  image.name = std::to_string(width) + " by " + std::to_string(height);
  image.width = width;
  image.height = height;
  for (uint32_t i = 0; i < width * height; ++i) image.rgba.insert(image.rgba.end(), texel.begin(), texel.end());
  return image;
}

/// A scene whose materials use each image as a colour, or also as data.
Scene scene_of(const std::vector<Image>& images, bool as_data = false) {
  Scene scene;
  scene.images = images;
  for (int32_t i = 0; i < static_cast<int32_t>(images.size()); ++i) {
    Material& material = scene.materials.emplace_back();
    material.base_color_texture.image = i;
    if (as_data) material.normal_texture.image = i;
  }
  return scene;
}

TEST(TexturePages, EqualImagesShareAPageAndUsesAreKeptApart) {
  const Scene scene =
      scene_of({make_image(8, 4, {1, 2, 3, 4}), make_image(4, 4, {5, 6, 7, 8}), make_image(8, 4, {9, 9, 9, 9})}, true);
  const TexturePages pages = build_texture_pages(scene);
  ASSERT_EQ(pages.pages.size(), 4u);
  EXPECT_TRUE(pages.warnings.empty());
  for (size_t i = 0; i < scene.images.size(); ++i) {
    for (const bool srgb : {true, false}) {
      const TexturePlace place = (srgb ? pages.srgb_places : pages.linear_places)[i];
      const TexturePage& page = pages.pages.at(place.page);
      EXPECT_EQ(page.srgb, srgb);
      EXPECT_EQ(page.width, scene.images[i].width);
      EXPECT_EQ(page.images.at(place.layer), i);
      const size_t layer_size = scene.images[i].rgba.size();
      EXPECT_TRUE(std::equal(scene.images[i].rgba.begin(), scene.images[i].rgba.end(),
                             page.mips[0].begin() + static_cast<std::ptrdiff_t>(place.layer * layer_size)));
    }
  }
  EXPECT_EQ(pages.srgb_places[0].page, pages.srgb_places[2].page);
  EXPECT_NE(pages.srgb_places[0].layer, pages.srgb_places[2].layer);
}

TEST(TexturePages, MipChainEndsAtOneTexelAndKeepsConstants) {
  const TexturePages pages = build_texture_pages(scene_of({make_image(13, 5, {200, 17, 90, 255})}));
  const TexturePage& page = pages.pages.at(0);
  ASSERT_EQ(page.mips.size(), 4u);
  uint32_t width = 13, height = 5;
  for (const std::vector<uint8_t>& mip : page.mips) {
    ASSERT_EQ(mip.size(), size_t{width} * height * 4);
    for (size_t i = 0; i < mip.size(); i += 4) {
      EXPECT_NEAR(mip[i], 200, 1);
      EXPECT_NEAR(mip[i + 1], 17, 1);
      EXPECT_EQ(mip[i + 3], 255);
    }
    width = std::max(1u, width / 2);
    height = std::max(1u, height / 2);
  }
}

TEST(TexturePages, ColoursAreAveragedInLinearLight) {
  const std::vector<uint8_t> checker = {0, 0, 0, 0, 255, 255, 255, 255, 255, 255, 255, 255, 0, 0, 0, 0};
  const std::vector<uint8_t> colour = halve_image(checker, 2, 2, true), data = halve_image(checker, 2, 2, false);
  EXPECT_EQ(colour[0], 188) << "sRGB code of half the light";
  EXPECT_EQ(data[0], 128);
  EXPECT_EQ(colour[3], 128) << "alpha is linear";
}

TEST(TexturePages, OddSizesKeepTheMean) {
  std::vector<uint8_t> ramp;
  for (int i = 0; i < 5 * 3; ++i) ramp.insert(ramp.end(), 4, static_cast<uint8_t>(i * 16));
  const std::vector<uint8_t> halved = halve_image(ramp, 5, 3, false);
  ASSERT_EQ(halved.size(), 2u * 1 * 4);
  EXPECT_NEAR((halved[0] + halved[4]) / 2.0, 7 * 16, 1);
}

TEST(TexturePages, SrgbTableInvertsItself) {
  for (int code = 0; code < 256; ++code) EXPECT_EQ(linear_to_srgb(srgb_to_linear(static_cast<uint8_t>(code))), code);
  EXPECT_NEAR(srgb_to_linear(188), 0.5f, 0.01f);
}

TEST(TexturePages, AlphaMaskKeepsItsCoverage) {
  // Leaves: single opaque texels strewn over a quarter of the image. Plain averages reach the cutoff only where two of
  // four texels are opaque.
  Image image = make_image(64, 64, {100, 100, 100, 0});
  std::mt19937 random(5);
  std::vector<uint32_t> texels(64 * 64);
  std::iota(texels.begin(), texels.end(), 0u);
  std::shuffle(texels.begin(), texels.end(), random);
  for (size_t i = 0; i < texels.size() / 4; ++i) image.rgba[texels[i] * 4 + 3] = 255;
  Scene scene = scene_of({image});
  scene.materials[0].alpha_mode = AlphaMode::mask;
  scene.materials[0].alpha_cutoff = 0.5f;
  const TexturePages pages = build_texture_pages(scene);
  const auto covered = [&](size_t level) {
    size_t count = 0;
    const std::vector<uint8_t>& mip = pages.pages[0].mips[level];
    for (size_t i = 3; i < mip.size(); i += 4) count += mip[i] >= 128 ? 1u : 0u;
    return static_cast<double>(count) / static_cast<double>(mip.size() / 4);
  };
  EXPECT_NEAR(covered(0), 0.25, 1e-9);
  // Level 1 has five values of alpha only, so its coverage comes in steps; from there on it must stay close.
  for (size_t level = 2; level < 5; ++level) EXPECT_NEAR(covered(level), 0.25, 0.12) << level;
  EXPECT_GT(covered(4), 0.12) << "plain averages are all near a quarter, where nothing passes";
}

TEST(TexturePages, MoreSizesThanPagesAreResampledWithAWarning) {
  std::vector<Image> images;
  for (uint32_t i = 0; i < 15; ++i)
    images.push_back(make_image(4 + i, 8, {static_cast<uint8_t>(100 + i), 50, 20, 255}));
  const Scene scene = scene_of(images);
  const TexturePages pages = build_texture_pages(scene);
  EXPECT_EQ(pages.pages.size(), kTexturePageCount);
  EXPECT_GE(pages.warnings.size(), 3u);
  for (size_t i = 0; i < images.size(); ++i) {
    const TexturePlace place = pages.srgb_places[i];
    const TexturePage& page = pages.pages.at(place.page);
    const uint8_t* layer = &page.mips[0][place.layer * size_t{page.width} * page.height * 4];
    for (size_t texel = 0; texel < size_t{page.width} * page.height; ++texel)
      EXPECT_NEAR(layer[texel * 4], 100 + static_cast<int>(i), 1);
  }
  const TexturePages again = build_texture_pages(scene);
  for (size_t p = 0; p < pages.pages.size(); ++p) EXPECT_EQ(pages.pages[p].mips, again.pages[p].mips);
}

TEST(TexturePages, NoTexturesNoPages) {
  Scene scene;
  scene.materials.resize(2);
  EXPECT_TRUE(build_texture_pages(scene).pages.empty());
}

TEST(GpuMaterial, CarriesEveryField) {
  Scene scene = scene_of({make_image(2, 2, {1, 1, 1, 1}), make_image(2, 2, {255, 255, 255, 255})}, true);
  Material& material = scene.materials[1];
  material.base_color = {0.1f, 0.2f, 0.3f, 0.4f};
  material.emission = {4, 2, 1};
  material.emissive_texture.image = 1;
  material.metallic = 0.5f;
  material.roughness = 0.25f;
  material.specular_factor = 0.75f;
  material.normal_scale = 2;
  material.specular_color = {0.9f, 0.8f, 0.7f};
  material.anisotropy_strength = 0.6f;
  material.anisotropy_rotation = glm::half_pi<float>();
  material.alpha_mode = AlphaMode::mask;
  material.alpha_cutoff = 0.3f;
  material.double_sided = material.unlit = true;
  material.base_color_texture.wrap_u = Wrap::clamp;
  material.base_color_texture.wrap_v = Wrap::mirror;
  material.base_color_texture.nearest = true;
  material.base_color_texture.texcoord = 1;
  material.base_color_texture.offset = {5, 6};
  material.base_color_texture.linear_transform = glm::mat2(1, 2, 3, 4);
  scene.vertices.resize(3);
  scene.triangles.push_back({0, 1, 2, 1, 0});
  const TexturePages pages = build_texture_pages(scene);
  const EmissionTable emission = build_emission_table(scene);
  const std::vector<GpuMaterial> packed = pack_materials(scene, pages, emission);
  ASSERT_EQ(packed.size(), 2u);
  const GpuMaterial& gpu = packed[1];
  EXPECT_EQ(gpu.base_color, material.base_color);
  EXPECT_EQ(glm::vec3(gpu.emission), material.emission);
  EXPECT_NEAR(gpu.emission.w, 0.5f * luminance(material.emission), 1e-5);
  EXPECT_EQ(gpu.surface, glm::vec4(0.5f, 0.25f, 0.75f, 2));
  EXPECT_EQ(gpu.specular, glm::vec4(0.9f, 0.8f, 0.7f, 0.6f));
  EXPECT_NEAR(gpu.shape.x, 0, 1e-6);
  EXPECT_NEAR(gpu.shape.y, 1, 1e-6);
  EXPECT_EQ(gpu.shape.z, 0.3f);
  EXPECT_NEAR(gpu.shape.w, 0.04f, 1e-6);
  EXPECT_EQ(gpu.flags, glm::uvec4(1, 1, 1, 1));
  EXPECT_EQ(gpu.base_color_texture.page, pages.srgb_places[1].page);
  EXPECT_EQ(gpu.base_color_texture.layer, pages.srgb_places[1].layer);
  EXPECT_EQ(gpu.normal_texture.page, pages.linear_places[1].page);
  EXPECT_EQ(gpu.base_color_texture.sampling, 1u | 2u << 2 | 16u);
  EXPECT_EQ(gpu.base_color_texture.texcoord, 1u);
  // uv' = (x*u + z*v, y*u + w*v) + offset
  EXPECT_EQ(gpu.base_color_texture.linear_transform, glm::vec4(1, 2, 3, 4));
  EXPECT_EQ(gpu.base_color_texture.offset, glm::vec2(5, 6));
  EXPECT_EQ(gpu.specular_texture.page, 0xFFFFFFFFu);
  EXPECT_EQ(packed[0].flags.z, 0u);
  EXPECT_EQ(packed[0].emission, glm::vec4(0));
}

TEST(TexturePages, SponzaFits) {
  LIGHTLOOM_NEED_SHARED(folder);
  const Scene scene = load_scene(folder / "sponza_glossy.scene.json");
  const TexturePages pages = build_texture_pages(scene);
  EXPECT_LE(pages.pages.size(), kTexturePageCount);
  EXPECT_TRUE(pages.warnings.empty());
  size_t layers = 0;
  for (const TexturePage& page : pages.pages) layers += page.images.size();
  EXPECT_EQ(layers, 35u);
}

}  // namespace
}  // namespace lightloom::scene
