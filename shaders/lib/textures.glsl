// Material textures: pages are array images of one size and colour space each, sampled with trilinear filtering and
// repeat. Wrap modes and nearest filtering are done here, because one page serves textures with different samplers.
// Pages are selected by constant indices: dynamic indexing of sampled images is not available on every device.
#ifndef LIGHTLOOM_LIB_TEXTURES
#define LIGHTLOOM_LIB_TEXTURES

#include "lib/features.glsl"
#include "lib/scene.glsl"

uniform sampler2DArray texture_pages[kTexturePageCount];
uniform sampler2D environment_map;   // equirectangular, linear radiance; sampled only where has_environment_image

const uint kNoTexture = 0xFFFFFFFFu;
const uint kWrapRepeat = 0u;
const uint kWrapMirror = 2u;

// Where on the material's textures a sample lies, and how far that moves to the neighbouring sample.
struct TexturePoint {
  vec4 uv;   // texture coordinates 0 in xy, 1 in zw
  vec4 dx;   // change to the next sample in one direction …
  vec4 dy;   // … and in the other
};

// Is `page`, one of `pages`, the page `index`, if it is none of a higher index? What is constant of it is folded away: a CPU
// device samples every page that it cannot rule out.
bool is_page(uint pages, uint page, uint index) {
  bool lowest = (pages & ((1u << index) - 1u)) == 0u;
  return (pages >> index & 1u) != 0u && (lowest || page == index);
}

// Size [texels] of a page, one of `pages`.
vec2 page_size(uint pages, uint page) {
  if (is_page(pages, page, 11u)) return vec2(textureSize(texture_pages[11], 0).xy);
  if (is_page(pages, page, 10u)) return vec2(textureSize(texture_pages[10], 0).xy);
  if (is_page(pages, page, 9u)) return vec2(textureSize(texture_pages[9], 0).xy);
  if (is_page(pages, page, 8u)) return vec2(textureSize(texture_pages[8], 0).xy);
  if (is_page(pages, page, 7u)) return vec2(textureSize(texture_pages[7], 0).xy);
  if (is_page(pages, page, 6u)) return vec2(textureSize(texture_pages[6], 0).xy);
  if (is_page(pages, page, 5u)) return vec2(textureSize(texture_pages[5], 0).xy);
  if (is_page(pages, page, 4u)) return vec2(textureSize(texture_pages[4], 0).xy);
  if (is_page(pages, page, 3u)) return vec2(textureSize(texture_pages[3], 0).xy);
  if (is_page(pages, page, 2u)) return vec2(textureSize(texture_pages[2], 0).xy);
  if (is_page(pages, page, 1u)) return vec2(textureSize(texture_pages[1], 0).xy);
  return vec2(textureSize(texture_pages[0], 0).xy);
}

vec4 page_texel(uint pages, uint page, vec3 where, float lod) {
  if (is_page(pages, page, 11u)) return textureLod(texture_pages[11], where, lod);
  if (is_page(pages, page, 10u)) return textureLod(texture_pages[10], where, lod);
  if (is_page(pages, page, 9u)) return textureLod(texture_pages[9], where, lod);
  if (is_page(pages, page, 8u)) return textureLod(texture_pages[8], where, lod);
  if (is_page(pages, page, 7u)) return textureLod(texture_pages[7], where, lod);
  if (is_page(pages, page, 6u)) return textureLod(texture_pages[6], where, lod);
  if (is_page(pages, page, 5u)) return textureLod(texture_pages[5], where, lod);
  if (is_page(pages, page, 4u)) return textureLod(texture_pages[4], where, lod);
  if (is_page(pages, page, 3u)) return textureLod(texture_pages[3], where, lod);
  if (is_page(pages, page, 2u)) return textureLod(texture_pages[2], where, lod);
  if (is_page(pages, page, 1u)) return textureLod(texture_pages[1], where, lod);
  return textureLod(texture_pages[0], where, lod);
}

// Brings a coordinate to [0,1] by its wrap mode; where it must not blend with the opposite border, half a texel of the
// level that has `texels` texels is kept from it.
float wrap_coordinate(float x, uint mode, float texels) {
  if (mode == kWrapRepeat) return fract(x);
  float folded = mode == kWrapMirror ? 1.0 - abs(1.0 - mod(x, 2.0)) : x;
  return clamp(folded, 0.5 / texels, 1.0 - 0.5 / texels);
}

// Level of detail at which neighbouring samples are at most one texel apart; 0 where the texture is magnified.
float texture_lod(vec2 dx, vec2 dy, vec2 size) {
  vec2 step_x = dx * size;
  vec2 step_y = dy * size;
  float squared = max(dot(step_x, step_x), dot(step_y, step_y));
  return clamp(0.5 * log2(max(squared, 1.0)), 0.0, 16.0);
}

// Linear value of a material's texture, or `missing` where it has none. `pages`: those of textures of its kind.
vec4 sample_texture(uint pages, TextureSlot slot, TexturePoint point, vec4 missing) {
  if (!has_textured || pages == 0u || slot.page == kNoTexture) return missing;
  mat2 transform = mat2(slot.linear_transform.xy, slot.linear_transform.zw);
  bool second = slot.texcoord == 1u;
  vec2 uv = transform * (second ? point.uv.zw : point.uv.xy) + slot.offset;
  vec2 size = page_size(pages, slot.page);
  float lod = texture_lod(transform * (second ? point.dx.zw : point.dx.xy),
                          transform * (second ? point.dy.zw : point.dy.xy), size);
  bool nearest = (slot.sampling & 16u) != 0u;
  if (nearest) lod = round(lod);
  vec2 texels = max(floor(size * exp2(-ceil(lod))), vec2(1.0));
  uv = vec2(wrap_coordinate(uv.x, slot.sampling & 3u, texels.x),
            wrap_coordinate(uv.y, (slot.sampling >> 2) & 3u, texels.y));
  if (nearest) uv = (floor(uv * texels) + 0.5) / texels;
  return page_texel(pages, slot.page, vec3(uv, float(slot.layer)), lod);
}

#endif
