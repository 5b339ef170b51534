#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace lightloom::scene {

/// Relative luminance of linear Rec. 709 colour.
inline float luminance(const glm::vec3& color) {
  return 0.2126f * color.r + 0.7152f * color.g + 0.0722f * color.b;
}

/// sRGB transfer function, 8-bit code to linear [0,1] (IEC 61966-2-1).
inline float srgb_to_linear(uint8_t code) {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (size_t i = 0; i < values.size(); ++i) {
      const double c = static_cast<double>(i) / 255.0;
      values[i] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return values;
  }();
  return table[code];
}

/// Inverse of srgb_to_linear, rounded to the nearest code.
inline uint8_t linear_to_srgb(float linear) {
  const double value = static_cast<double>(linear);
  const double c = value <= 0.0031308 ? value * 12.92 : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
  return static_cast<uint8_t>(std::lround(std::fmin(std::fmax(c, 0.0), 1.0) * 255.0));
}

}  // namespace lightloom::scene
