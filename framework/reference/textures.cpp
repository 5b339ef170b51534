#include "framework/reference/textures.hpp"

#include <algorithm>
#include <cmath>

namespace lightloom::reference {
namespace {

/// The two texels between which a coordinate lies, and the share of the second.
struct Pair {
  uint32_t first = 0, second = 0;
  float share = 0;
};

uint32_t wrapped(int64_t texel, int64_t size, scene::Wrap wrap) {
  switch (wrap) {
    case scene::Wrap::clamp:
      return static_cast<uint32_t>(std::clamp<int64_t>(texel, 0, size - 1));
    case scene::Wrap::mirror: {
      const int64_t inside = ((texel % (2 * size)) + 2 * size) % (2 * size);
      return static_cast<uint32_t>(std::min(inside, 2 * size - 1 - inside));
    }
    case scene::Wrap::repeat:
      break;
  }
  return static_cast<uint32_t>(((texel % size) + size) % size);
}

Pair neighbours(float coordinate, uint32_t size, scene::Wrap wrap, bool nearest) {
  // Far outside, where whole turns have eaten the digits, nothing but a finite place is asked for.
  const double place = std::clamp(static_cast<double>(coordinate), -1e9, 1e9) * size;
  if (nearest) {
    const uint32_t texel = wrapped(static_cast<int64_t>(std::floor(place)), size, wrap);
    return {texel, texel, 0};
  }
  const double below = std::floor(place - 0.5);
  const auto first = static_cast<int64_t>(below);
  return {wrapped(first, size, wrap), wrapped(first + 1, size, wrap), static_cast<float>(place - 0.5 - below)};
}

}  // namespace

Textures::Textures(const scene::Scene& scene) : pages_(scene::build_texture_pages(scene)) {
  for (size_t code = 0; code < srgb_.size(); ++code) {
    const double value = static_cast<double>(code) / 255;
    srgb_[code] = static_cast<float>(value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
  }
}

Textures::Place Textures::place(const scene::TextureUse& use, bool srgb) const {
  const scene::TexturePlace& found = (srgb ? pages_.srgb_places : pages_.linear_places)[static_cast<size_t>(use.image)];
  return {&pages_.pages[found.page], found.layer};
}

glm::vec4 Textures::level_sample(const Place& place, const scene::TextureUse& use, const glm::vec2& uv,
                                 uint32_t level) const {
  const scene::TexturePage& page = *place.page;
  const uint32_t width = std::max(1u, page.width >> level), height = std::max(1u, page.height >> level);
  const Pair columns = neighbours(uv.x, width, use.wrap_u, use.nearest);
  const Pair rows = neighbours(uv.y, height, use.wrap_v, use.nearest);
  const uint8_t* texels = page.mips[level].data() + size_t{place.layer} * width * height * 4;
  const auto texel = [&](uint32_t x, uint32_t y) {
    const uint8_t* code = texels + (size_t{y} * width + x) * 4;
    const auto unorm = [](uint8_t value) { return static_cast<float>(value) * (1.0f / 255); };
    return page.srgb ? glm::vec4(srgb_[code[0]], srgb_[code[1]], srgb_[code[2]], unorm(code[3]))
                     : glm::vec4(unorm(code[0]), unorm(code[1]), unorm(code[2]), unorm(code[3]));
  };
  if (use.nearest) return texel(columns.first, rows.first);
  const glm::vec4 top = glm::mix(texel(columns.first, rows.first), texel(columns.second, rows.first), columns.share);
  const glm::vec4 bottom =
      glm::mix(texel(columns.first, rows.second), texel(columns.second, rows.second), columns.share);
  return glm::mix(top, bottom, rows.share);
}

glm::vec4 Textures::sample(const scene::TextureUse& use, bool srgb, const TexturePoint& point) const {
  const Place where = place(use, srgb);
  const glm::vec2 uv = use.linear_transform * point.uv[use.texcoord] + use.offset;
  if (!point.filtered) return level_sample(where, use, uv, 0);
  const glm::vec2 size(where.page->width, where.page->height);
  const glm::vec2 dx = use.linear_transform * point.dx[use.texcoord] * size;
  const glm::vec2 dy = use.linear_transform * point.dy[use.texcoord] * size;
  const float extent = std::max(glm::dot(dx, dx), glm::dot(dy, dy));
  const auto last = static_cast<float>(where.page->mips.size() - 1);
  const float level = extent > 1 ? std::min(0.5f * std::log2(extent), last) : 0;
  if (use.nearest) return level_sample(where, use, uv, static_cast<uint32_t>(std::lround(level)));
  const auto finer = static_cast<uint32_t>(level);
  const float share = level - static_cast<float>(finer);
  const glm::vec4 fine = level_sample(where, use, uv, finer);
  return share > 0 ? glm::mix(fine, level_sample(where, use, uv, finer + 1), share) : fine;
}

}  // namespace lightloom::reference
