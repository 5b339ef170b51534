#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "framework/base/limits.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::scene {

constexpr size_t kTexturePageCount = 12;  ///< as in shaders/lib/scene.glsl

/// Images of equal size and colour space, as layers of one array texture with all its mip levels.
struct TexturePage {
  uint32_t width = 0, height = 0;
  bool srgb = false;
  std::vector<uint32_t> images;            ///< by layer: index into Scene::images
  std::vector<std::vector<uint8_t>> mips;  ///< by level: RGBA8, layer after layer; level k is max(1, size >> k)
};

struct TexturePlace {
  uint32_t page = 0xFFFFFFFFu;  ///< none
  uint32_t layer = 0;
};

struct TexturePages {
  std::vector<TexturePage> pages;           ///< at most kTexturePageCount
  std::vector<TexturePlace> srgb_places;    ///< by image, where it is read as a colour
  std::vector<TexturePlace> linear_places;  ///< by image, where it is read as data
  std::vector<std::string> warnings;
};

/// Sorts the images that materials use into pages. An image that is read as colour and as data gets a layer of each
/// kind. Where there are more sizes than pages, the images of the sizes with the fewest texels are resampled to the
/// nearest larger size (or the largest) of their colour space, with a warning.
/// Mips are box-filtered, colours in linear light; the alpha of images that mask keeps its coverage at the cutoff.
[[nodiscard]] TexturePages build_texture_pages(const Scene& scene);

/// Throws Error where the pages would have more texels than Limits::page_texels: a thousand tiny images of different
/// sizes beside a large one can become a thousand large ones.
void require_texture_pages_within(const Scene& scene, const Limits& limits);

/// Next smaller level of one RGBA8 image; odd sizes are halved downwards, each texel averaging the area it covers.
[[nodiscard]] std::vector<uint8_t> halve_image(const std::vector<uint8_t>& rgba, uint32_t width, uint32_t height,
                                               bool srgb);

}  // namespace lightloom::scene
