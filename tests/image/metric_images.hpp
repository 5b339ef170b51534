#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <random>

#include "framework/image/host_image.hpp"

namespace lightloom::image {

using Rgb = std::array<double, 3>;

/// rgba32_sfloat, alpha 1.
inline HostImage color_image(uint32_t width, uint32_t height, const std::function<Rgb(uint32_t, uint32_t)>& at) {
  HostImage image{{Format::rgba32_sfloat, Dimension::d2, {width, height, 1}}, {}};
  image.texels.resize(byte_size(image.desc));
  std::byte* to = image.texels.data();
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const Rgb rgb = at(x, y);
      const std::array<float, 4> texel = {float(rgb[0]), float(rgb[1]), float(rgb[2]), 1.0f};
      std::memcpy(to, texel.data(), sizeof texel);
      to += sizeof texel;
    }
  }
  return image;
}

inline HostImage grey_image(uint32_t width, uint32_t height, const std::function<double(uint32_t, uint32_t)>& at) {
  return color_image(width, height, [&](uint32_t x, uint32_t y) {
    const double value = at(x, y);
    return Rgb{value, value, value};
  });
}

inline HostImage constant_image(uint32_t width, uint32_t height, const Rgb& rgb) {
  return color_image(width, height, [&](uint32_t, uint32_t) { return rgb; });
}

/// Smooth shapes and edges in colours from 0 to `scale`, with uniform noise of that amplitude times `noise`.
inline HostImage test_picture(uint32_t width, uint32_t height, double scale, double noise, uint32_t seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  return color_image(width, height, [&](uint32_t x, uint32_t y) {
    const double u = (x + 0.5) / width, v = (y + 0.5) / height;
    const double disc = std::hypot(u - 0.4, v - 0.6) < 0.25 ? 0.3 : 0;
    Rgb rgb = {0.5 * u + disc, 0.6 * v, 0.35 + 0.3 * std::sin(14 * u) * std::cos(9 * v)};
    for (double& channel : rgb) channel = scale * std::clamp(channel + noise * uniform(generator), 0.0, 1.0);
    return rgb;
  });
}

}  // namespace lightloom::image
