// Textures on what `gather` sees: where they lie, what is cut out, and how finely they are sampled.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "tests/passes/gather_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

using GatherTexture = DeviceTest;

/// A quad in front of the camera with an image on it, u to the right, v upwards, and a second quad behind it.
scene::Scene textured_scene(const scene::Image& image, bool mask) {
  scene::Material front = plain(glm::vec3(1));
  front.base_color_texture.image = 0;
  front.alpha_mode = mask ? scene::AlphaMode::mask : scene::AlphaMode::opaque;
  scene::Scene scene =
      make_quad_scene({facing_quad(0, 1, 1), facing_quad(-1, 3, 3, 1)}, {front, plain({0, 0, 1})}, front_camera(3));
  scene.images = {image};
  scene.features.textured = true;
  scene.features.alpha = mask;
  return scene;
}

TEST_F(GatherTexture, RowZeroOfAnImageIsAtVZero) {
  const scene::Image image = make_image(64, 64, [](uint32_t x, uint32_t y) {
    return std::array<uint8_t, 4>{uint8_t(x < 32 ? 255 : 0), uint8_t(y < 32 ? 255 : 0), 0, 255};
  });
  const Images images = gather(textured_scene(image, false));
  // v grows upwards on this quad, so the image stands on its head.
  for (int y = 0; y < kViewHeight; ++y) {
    for (int x = 0; x < kViewWidth; ++x) {
      const glm::dvec3 at = on_plane(x, y, 3, 0);
      const double border = std::min(std::abs(at.x), std::abs(at.y));
      if (std::max(std::abs(at.x), std::abs(at.y)) > 0.95 || border < 0.1) continue;
      EXPECT_NEAR(texel(images, "albedo", x, y)[kX], at.x < 0 ? 1 : 0, 1e-3) << x << ' ' << y;
      EXPECT_NEAR(texel(images, "albedo", x, y)[kY], at.y < 0 ? 1 : 0, 1e-3) << x << ' ' << y;
    }
  }
}

TEST_F(GatherTexture, ThroughCutOutTexelsOneSeesWhatLiesBehind) {
  const scene::Image image = make_image(64, 64, [](uint32_t x, uint32_t) {
    return std::array<uint8_t, 4>{255, 255, 255, uint8_t(x < 32 ? 255 : 0)};
  });
  for (const bool mask : {true, false}) {
    const Images images = gather(textured_scene(image, mask));
    for (int x = 0; x < kViewWidth; ++x) {
      const glm::dvec3 at = on_plane(x, 24, 3, 0);
      if (std::abs(at.x) > 0.95 || std::abs(at.x) < 0.1) continue;
      const bool sees_front = !mask || at.x < 0;
      EXPECT_EQ(texel(images, "id", x, 24)[kY], sees_front ? 0 : 1) << x;
      EXPECT_NEAR(texel(images, "position", x, 24)[kZ], sees_front ? 0 : -1, 1e-4) << x;
    }
  }
}

TEST_F(GatherTexture, AFineTextureFarAwayIsItsMean) {
  // About ten texels a pixel; the mean of black and white in linear light is 1/2.
  const scene::Image checker = make_image(256, 256, [](uint32_t x, uint32_t y) {
    const auto value = uint8_t((x + y) % 2 * 255);
    return std::array<uint8_t, 4>{value, value, value, 255};
  });
  const Images images = gather(textured_scene(checker, false));
  for (int x = 26; x < 38; ++x) EXPECT_NEAR(texel(images, "albedo", x, 24)[kX], 0.5, 0.01) << x;
}

/// Texel coordinate that glTF's wrap modes give, of `size` texels.
int wrapped(int i, scene::Wrap wrap, int size) {
  if (wrap == scene::Wrap::clamp) return std::clamp(i, 0, size - 1);
  const int period = wrap == scene::Wrap::mirror ? 2 * size : size;
  const int r = ((i % period) + period) % period;
  return r < size ? r : period - 1 - r;
}

TEST_F(GatherTexture, TextureUsesHaveTheirTransformTheirWrapModesAndTheirCoordinates) {
  // The three channels are the bits of the texel's place in the image of 4 x 2.
  const scene::Image code = make_image(4, 2, [](uint32_t x, uint32_t y) {
    return std::array<uint8_t, 4>{uint8_t(x % 2 * 255), uint8_t(x / 2 * 255), uint8_t(y * 255), 255};
  });
  using Wraps = std::pair<scene::Wrap, scene::Wrap>;
  for (const Wraps& wraps :
       {Wraps{scene::Wrap::repeat, scene::Wrap::mirror}, Wraps{scene::Wrap::mirror, scene::Wrap::clamp},
        Wraps{scene::Wrap::clamp, scene::Wrap::repeat}}) {
    scene::Scene scene = textured_scene(code, false);
    scene::TextureUse& use = scene.materials[0].base_color_texture;
    use.nearest = true;
    use.texcoord = 1;
    use.wrap_u = wraps.first;
    use.wrap_v = wraps.second;
    use.linear_transform = glm::mat2(2.0f, 0.5f, -0.5f, 3.0f);
    use.offset = {-0.3f, -0.7f};
    for (scene::Vertex& vertex : scene.vertices) vertex.uv1 = {vertex.u0 + 0.1f, vertex.v0 * 0.5f};
    const Images images = gather(scene);
    for (int y = 0; y < kViewHeight; ++y) {
      for (int x = 0; x < kViewWidth; ++x) {
        const glm::dvec3 at = on_plane(x, y, 3, 0);
        if (std::max(std::abs(at.x), std::abs(at.y)) > 0.95) continue;
        const glm::dvec2 uv((at.x + 1) / 2 + 0.1, (at.y + 1) / 4);
        const glm::dvec2 moved = glm::dmat2(use.linear_transform) * uv + glm::dvec2(use.offset);
        const glm::dvec2 texels(moved.x * 4, moved.y * 2);
        const glm::dvec2 from_border = glm::abs(texels - glm::round(texels));
        if (std::min(from_border.x, from_border.y) < 1e-3) continue;
        const int i = wrapped(static_cast<int>(std::floor(texels.x)), wraps.first, 4);
        const int j = wrapped(static_cast<int>(std::floor(texels.y)), wraps.second, 2);
        ASSERT_EQ(texel(images, "albedo", x, y), glm::dvec4(i % 2, i / 2, j, 0)) << x << ' ' << y;
      }
    }
  }
}

/// A pyramid of mip levels in linear light, made without the program's.
class Pyramid {
 public:
  explicit Pyramid(const scene::Image& image) {
    Level level{static_cast<int>(image.width), {}};
    for (size_t i = 0; i < image.rgba.size(); i += 4) {
      glm::dvec3& texel = level.texels.emplace_back();
      for (int k = 0; k < 3; ++k) texel[k] = linear(image.rgba[i + static_cast<size_t>(k)]);
    }
    for (levels_.push_back(level); levels_.back().size > 1;) levels_.push_back(halved(levels_.back()));
  }

  /// Trilinear, repeating; `place` in images.
  [[nodiscard]] glm::dvec3 sample(const glm::dvec2& place, double lod) const {
    const double clamped = std::clamp(lod, 0.0, static_cast<double>(levels_.size() - 1));
    const auto fine = static_cast<size_t>(clamped);
    const size_t coarse = std::min(fine + 1, levels_.size() - 1);
    return glm::mix(bilinear(levels_[fine], place), bilinear(levels_[coarse], place), clamped - std::floor(clamped));
  }

 private:
  struct Level {
    int size = 1;
    std::vector<glm::dvec3> texels = {};
    [[nodiscard]] const glm::dvec3& at(int x, int y) const {
      const auto inside = [this](int i) { return ((i % size) + size) % size; };
      return texels[static_cast<size_t>(inside(y) * size + inside(x))];
    }
  };

  static double linear(uint8_t code) {
    const double c = code / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  }

  static Level halved(const Level& from) {
    Level level{from.size / 2, {}};
    for (int y = 0; y < level.size; ++y)
      for (int x = 0; x < level.size; ++x)
        level.texels.push_back((from.at(2 * x, 2 * y) + from.at(2 * x + 1, 2 * y) + from.at(2 * x, 2 * y + 1) +
                                from.at(2 * x + 1, 2 * y + 1)) *
                               0.25);
    return level;
  }

  static glm::dvec3 bilinear(const Level& level, const glm::dvec2& place) {
    const glm::dvec2 texels = place * static_cast<double>(level.size) - 0.5;
    const glm::dvec2 corner = glm::floor(texels);
    const int x = static_cast<int>(corner.x), y = static_cast<int>(corner.y);
    const glm::dvec2 part = texels - corner;
    return glm::mix(glm::mix(level.at(x, y), level.at(x + 1, y), part.x),
                    glm::mix(level.at(x, y + 1), level.at(x + 1, y + 1), part.x), part.y);
  }

  std::vector<Level> levels_;
};

/// A plane z = slope x with an image of `texels` squared on it, once in each metre.
struct TexturedPlane {
  static constexpr double kSlope = 0.5;
  static constexpr float kHalf = 64;  ///< [m]
  double distance;                    ///< of the front camera from the origin

  [[nodiscard]] scene::Scene scene(const scene::Image& image) const {
    const float rise = static_cast<float>(kSlope) * kHalf;
    scene::Material material = plain(glm::vec3(1));
    material.base_color_texture.image = 0;
    material.base_color_texture.linear_transform = glm::mat2(2 * kHalf, 0, 0, 2 * kHalf);
    scene::Scene made = make_quad_scene({{{-kHalf, -kHalf, -rise}, {2 * kHalf, 0, 2 * rise}, {0, 2 * kHalf, 0}, 0}},
                                        {material}, front_camera(static_cast<float>(distance)));
    made.images = {image};
    made.features.textured = true;
    return made;
  }

  /// In images, from the plane's corner on; also of pixels beyond the view.
  [[nodiscard]] glm::dvec2 place(int x, int y) const {
    const glm::dvec3 at = on_plane(x, y, distance, kSlope);
    return glm::dvec2(at) + double{kHalf};
  }

  /// Texels from a pixel's centre to that of the next one, the longer of right and down, as a power of two.
  [[nodiscard]] double level(int x, int y, int texels) const {
    const double across = glm::length(place(x + 1, y) - place(x, y));
    const double down = glm::length(place(x, y + 1) - place(x, y));
    return std::max(0.0, std::log2(std::max(across, down) * texels));
  }
};

scene::Image noise_image(uint32_t size) {
  std::mt19937 random(3);
  return make_image(size, size, [&](uint32_t, uint32_t) {
    const auto bits = static_cast<uint32_t>(random());
    return std::array<uint8_t, 4>{uint8_t(bits), uint8_t(bits >> 8U), uint8_t(bits >> 16U), 255};
  });
}

/// Root of the mean squared difference of the albedos from a texture sampled `shift` levels coarser than it should be.
double error_at(const TexturedPlane& plane, const Images& images, const Pyramid& pyramid, int texels, double shift) {
  double sum = 0;
  for (int y = 0; y < kViewHeight; ++y) {
    for (int x = 0; x < kViewWidth; ++x) {
      const glm::dvec3 expected = pyramid.sample(plane.place(x, y), plane.level(x, y, texels) + shift);
      const glm::dvec3 off = glm::dvec3(texel(images, "albedo", x, y)) - expected;
      sum += glm::dot(off, off);
    }
  }
  return std::sqrt(sum / (3 * kViewWidth * kViewHeight));
}

constexpr int kNoiseTexels = 256;
constexpr double kRounding = 0.002;  ///< of what 8 bits a channel and half floats leave, as a root mean square

TEST_F(GatherTexture, TheLevelIsThatOfTheFootprintToATwentiethOfALevel) {
  const scene::Image image = noise_image(kNoiseTexels);
  const Pyramid pyramid(image);
  for (const double distance : {0.3, 1.0, 2.5, 7.0}) {  // levels 0.1 to 5.9, more than one in each view
    SCOPED_TRACE(distance);
    const TexturedPlane plane{distance};
    const Images images = gather(plane.scene(image));
    const auto error = [&](double shift) { return error_at(plane, images, pyramid, kNoiseTexels, shift); };
    EXPECT_LT(error(0), kRounding);
    EXPECT_GT(error(-0.05), error(0)) << "finer";
    EXPECT_GT(error(0.05), error(0)) << "coarser";
  }
}

TEST_F(GatherTexture, UpCloseTheImageItselfIsInterpolated) {
  const scene::Image image = noise_image(kNoiseTexels);
  const TexturedPlane plane{0.04};
  ASSERT_LT(glm::length(plane.place(1, 1) - plane.place(0, 0)) * kNoiseTexels, 0.5) << "half a texel a pixel";
  const Images images = gather(plane.scene(image));
  EXPECT_LT(error_at(plane, images, Pyramid(image), kNoiseTexels, 0), kRounding);
}

}  // namespace
}  // namespace lightloom::test
