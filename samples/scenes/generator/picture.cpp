#include "samples/scenes/generator/picture.hpp"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <stdexcept>

namespace lightloom::samples {

namespace {

/// Uniform in [0, 1) from integers alone, so that it is the same everywhere.
double hash(uint32_t x, uint32_t y, uint32_t seed) {
  uint32_t h = x * 0x8DA6B343u + y * 0xD8163841u + seed * 0xCB1AB31Fu;
  h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12)) * 0x297A2D39u;
  return (h ^ (h >> 15)) / 4294967296.0;
}

/// Smooth value noise in [0, 1) on `cells` x `cells`, periodic in the unit square.
double noise(double x, double y, uint32_t cells, uint32_t seed) {
  const double gx = x * cells, gy = y * cells;
  const double fx = gx - std::floor(gx), fy = gy - std::floor(gy);
  const uint32_t x0 = static_cast<uint32_t>(std::floor(gx)) % cells, y0 = static_cast<uint32_t>(std::floor(gy)) % cells;
  const uint32_t x1 = (x0 + 1) % cells, y1 = (y0 + 1) % cells;
  const double sx = fx * fx * (3 - 2 * fx), sy = fy * fy * (3 - 2 * fy);
  const double upper = hash(x0, y0, seed) * (1 - sx) + hash(x1, y0, seed) * sx;
  const double lower = hash(x0, y1, seed) * (1 - sx) + hash(x1, y1, seed) * sx;
  return upper * (1 - sy) + lower * sy;
}

uint8_t to_byte(double value) {
  return static_cast<uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255));
}

/// Calls `shade(u, v)` at each pixel's centre; u and v in (0, 1), v down. It returns one value a channel, in [0, 1].
template <typename Shade>
Picture paint(uint32_t width, uint32_t height, uint32_t channels, Shade shade) {
  Picture picture{width, height, channels, {}};
  picture.bytes.reserve(size_t{width} * height * channels);
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const glm::dvec4 value = shade((x + 0.5) / width, (y + 0.5) / height);
      for (uint32_t c = 0; c < channels; ++c) picture.bytes.push_back(to_byte(value[static_cast<int>(c)]));
    }
  }
  return picture;
}

struct Tile {
  uint32_t column, row;
  double edge;  ///< distance to the nearest edge, in tile sizes
  [[nodiscard]] bool dark() const { return (column + row) % 2 == 1; }
};
constexpr double kTileJoint = 0.014;

Tile tile_at(double u, double v) {
  const double x = u * 4, y = v * 4;
  const double fx = x - std::floor(x), fy = y - std::floor(y);
  return {static_cast<uint32_t>(x), static_cast<uint32_t>(y), std::min(std::min(fx, 1 - fx), std::min(fy, 1 - fy))};
}

struct Brick {
  uint32_t column, row;
  double edge;  ///< distance to the nearest edge, in brick heights
};

Brick brick_at(double u, double v) {
  const double y = v * 8;
  const auto row = static_cast<uint32_t>(y);
  const double x = u * 4 + (row % 2 == 1 ? 0.5 : 0.0);
  const double fx = x - std::floor(x), fy = y - std::floor(y);
  return {static_cast<uint32_t>(x) % 4, row, std::min(2 * std::min(fx, 1 - fx), std::min(fy, 1 - fy))};
}
constexpr double kBrickJoint = 0.06;

double brick_height(double u, double v) {
  const Brick brick = brick_at(u - std::floor(u), v - std::floor(v));
  const double rise = std::clamp((brick.edge - kBrickJoint) / 0.13, 0.0, 1.0);
  const double rounded = std::sqrt(rise * (2 - rise));
  const double lump = noise(u - std::floor(u), v - std::floor(v), 24, 5);
  const double proud = hash(brick.column, brick.row, 9);
  return rounded * (0.75 + 0.15 * proud + 0.2 * lump);
}

}  // namespace

Picture floor_tiles() {
  return paint(512, 512, 3, [](double u, double v) -> glm::dvec4 {
    const Tile tile = tile_at(u, v);
    if (tile.edge < kTileJoint) return {0.45, 0.43, 0.40, 1};
    const double shade = 0.94 + 0.06 * hash(tile.column, tile.row, 1);
    const double warp = noise(u, v, 6, 2) + 0.5 * noise(u, v, 14, 3);
    const double vein = std::clamp(1 - 14 * std::abs(warp - 0.75), 0.0, 1.0);
    const glm::dvec3 base = tile.dark() ? glm::dvec3(0.30, 0.35, 0.34) : glm::dvec3(0.89, 0.84, 0.75);
    const double step = std::round(vein * 4) / 4;
    return {base * shade + (tile.dark() ? 0.16 : -0.10) * step, 1};
  });
}

Picture floor_tiles_surface() {
  return paint(256, 256, 3, [](double u, double v) -> glm::dvec4 {
    const Tile tile = tile_at(u, v);
    if (tile.edge < kTileJoint) return {1, 0.75, 0, 1};
    return {1, tile.dark() ? 0.16 : 0.22, 0, 1};
  });
}

Picture brick_colour() {
  return paint(256, 256, 3, [](double u, double v) -> glm::dvec4 {
    const Brick brick = brick_at(u, v);
    if (brick.edge < kBrickJoint) return {0.72, 0.69, 0.63, 1};
    const double tint = hash(brick.column, brick.row, 7);
    return {glm::mix(glm::dvec3(0.66, 0.52, 0.40), glm::dvec3(0.83, 0.70, 0.55), tint), 1};
  });
}

Picture brick_normal() {
  return paint(512, 512, 3, [](double u, double v) -> glm::dvec4 {
    const double step = 1.0 / 512, slope = 0.011 / step / 2;
    const double right = (brick_height(u + step, v) - brick_height(u - step, v)) * slope;
    const double down = (brick_height(u, v + step) - brick_height(u, v - step)) * slope;
    return {glm::normalize(glm::dvec3(-right, down, 1)) * 0.5 + 0.5, 1};
  });
}

Picture palm_frond() {
  return paint(128, 256, 4, [](double u, double v) -> glm::dvec4 {
    const double across = std::abs(2 * u - 1), along = 1 - v;
    const double envelope = 0.95 * std::pow(std::sin(std::numbers::pi * std::pow(along, 0.75)), 0.6);
    const double comb = along * 15 - across * 3.5;
    const bool leaflet = across < envelope && comb - std::floor(comb) < 0.68;
    const bool stem = across < 0.07 * (1.2 - along) && along < 0.97;
    const glm::dvec3 colour = stem ? glm::dvec3(0.55, 0.58, 0.28) : glm::dvec3(0.20, 0.46 + 0.16 * along, 0.17);
    return {colour, leaflet || stem ? 1 : 0};
  });
}

Picture iron_grille() {
  return paint(256, 256, 4, [](double u, double v) -> glm::dvec4 {
    const double x = u * 4 - std::floor(u * 4);
    const bool bar = std::min(x, 1 - x) < 0.055;
    const bool rail = v < 0.05 || v > 0.95 || std::abs(v - 0.30) < 0.02;
    const double upper = std::hypot((x - 0.5) / 4, v - 0.175);
    const double lower = std::hypot((x - 0.5) / 4, v - 0.62);
    const bool ring = std::abs(upper - 0.095) < 0.016 || std::abs(lower - 0.10) < 0.016;
    return {0.16, 0.15, 0.14, bar || rail || ring ? 1 : 0};
  });
}

void write_png(const Picture& picture, const std::filesystem::path& file) {
  auto output = OIIO::ImageOutput::create(file.string());
  OIIO::ImageSpec spec(static_cast<int>(picture.width), static_cast<int>(picture.height),
                       static_cast<int>(picture.channels), OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("png:compressionLevel", 9);
  if (!output || !output->open(file.string(), spec) ||
      !output->write_image(OIIO::TypeDesc::UINT8, picture.bytes.data()) || !output->close()) {
    throw std::runtime_error("cannot write " + file.string() + ": " + (output ? output->geterror() : OIIO::geterror()));
  }
}

}  // namespace lightloom::samples
