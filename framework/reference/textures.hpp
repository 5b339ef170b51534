#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "framework/scene/scene.hpp"
#include "framework/scene/texture_pages.hpp"

namespace lightloom::reference {

/// Where on a material's textures a point lies, by set of texture coordinates.
struct TexturePoint {
  std::array<glm::vec2, 2> uv{};
  bool filtered = false;          ///< do dx and dy say something? If not, the finest level is looked up.
  std::array<glm::vec2, 2> dx{};  ///< change to the next pixel in x …
  std::array<glm::vec2, 2> dy{};  ///< … and in y
};

/// The images of a scene, for linear filtering: within one level, and between two where a point has an extent. Level 0
/// is the image as it is, unless there are more sizes of images than the pages of `scene::build_texture_pages` hold;
/// those are the ones that devices see, so that an image of either kind of tracer shows the same texels.
class Textures {
 public:
  explicit Textures(const scene::Scene& scene);

  /// Linear value; `srgb`: whether the image holds colour.
  [[nodiscard]] glm::vec4 sample(const scene::TextureUse& use, bool srgb, const TexturePoint& point) const;

 private:
  struct Place {
    const scene::TexturePage* page = nullptr;
    uint32_t layer = 0;
  };
  [[nodiscard]] Place place(const scene::TextureUse& use, bool srgb) const;
  [[nodiscard]] glm::vec4 level_sample(const Place& place, const scene::TextureUse& use, const glm::vec2& uv,
                                       uint32_t level) const;

  scene::TexturePages pages_;
  std::array<float, 256> srgb_{};  ///< IEC 61966-2-1, code to linear
};

}  // namespace lightloom::reference
