#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace lightloom::image::flip {

/// A colour in any of FLIP's spaces.
struct Triple {
  float x = 0, y = 0, z = 0;
};

using Matrix = std::array<std::array<double, 3>, 3>;

/// Linear RGB with the primaries of sRGB to CIE XYZ: the exact solution for the chromaticities of IEC 61966-2-1 and the
/// white point D65 (0.3127, 0.329).
constexpr Matrix kXyzFromRgb = {{{10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
                                 {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
                                 {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0}}};

/// Rows of sum 1: XYZ are then relative to those of white.
constexpr Matrix relative_to_white(Matrix matrix) {
  for (auto& row : matrix) {
    const double white = row[0] + row[1] + row[2];
    for (double& entry : row) entry /= white;
  }
  return matrix;
}

/// By cofactors.
constexpr Matrix inverse(const Matrix& m) {
  Matrix cofactors{};
  for (size_t r = 0; r < 3; ++r) {
    for (size_t c = 0; c < 3; ++c) {
      const auto &upper = m[(r + 1) % 3], &lower = m[(r + 2) % 3];
      cofactors[r][c] = upper[(c + 1) % 3] * lower[(c + 2) % 3] - upper[(c + 2) % 3] * lower[(c + 1) % 3];
    }
  }
  const double determinant = m[0][0] * cofactors[0][0] + m[0][1] * cofactors[0][1] + m[0][2] * cofactors[0][2];
  Matrix result{};
  for (size_t r = 0; r < 3; ++r)
    for (size_t c = 0; c < 3; ++c) result[r][c] = cofactors[c][r] / determinant;
  return result;
}

constexpr Matrix kToRelativeXyz = relative_to_white(kXyzFromRgb);
constexpr Matrix kFromRelativeXyz = inverse(kToRelativeXyz);

template <const Matrix& matrix>
[[nodiscard]] inline Triple transform(const Triple& from) {
  const auto row = [&from](size_t r) {
    return static_cast<float>(matrix[r][0]) * from.x + static_cast<float>(matrix[r][1]) * from.y +
           static_cast<float>(matrix[r][2]) * from.z;
  };
  return {row(0), row(1), row(2)};
}

/// The opponent space in which FLIP filters: linear in the light, with the scale of CIELAB (HPG 2020, section 4.1).
/// Y from -16 to 100 for colours from 0 to 1.
[[nodiscard]] inline Triple ycxcz_from_linear(const Triple& rgb) {
  const Triple xyz = transform<kToRelativeXyz>(rgb);
  return {116.0f * xyz.y - 16.0f, 500.0f * (xyz.x - xyz.y), 200.0f * (xyz.y - xyz.z)};
}

/// CIE XYZ relative to white.
[[nodiscard]] inline Triple xyz_from_ycxcz(const Triple& ycxcz) {
  const float y = (ycxcz.x + 16.0f) / 116.0f;
  return {y + ycxcz.y / 500.0f, y, y - ycxcz.z / 200.0f};
}

/// CIE XYZ relative to white to CIELAB (CIE 15).
[[nodiscard]] inline Triple lab_from_xyz(const Triple& xyz) {
  constexpr float kDelta = 6.0f / 29.0f;
  const auto f = [](float t) {
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3.0f * kDelta * kDelta) + 4.0f / 29.0f;
  };
  const float x = f(xyz.x), y = f(xyz.y), z = f(xyz.z);
  return {116.0f * y - 16.0f, 500.0f * (x - y), 200.0f * (y - z)};
}

/// CIELAB with chroma that grows with lightness (Hunt effect), as FLIP has it.
[[nodiscard]] inline Triple hunt_adjusted(const Triple& lab) {
  return {lab.x, 0.01f * lab.x * lab.y, 0.01f * lab.x * lab.z};
}

/// The distance HyAB (Abasi, Tehran, Fairchild 2019): city block in lightness, Euclidean in chroma.
[[nodiscard]] inline float hyab(const Triple& one, const Triple& other) {
  const float a = one.y - other.y, b = one.z - other.z;
  return std::abs(one.x - other.x) + std::sqrt(a * a + b * b);
}

[[nodiscard]] inline Triple clamped(const Triple& rgb) {
  return {std::clamp(rgb.x, 0.0f, 1.0f), std::clamp(rgb.y, 0.0f, 1.0f), std::clamp(rgb.z, 0.0f, 1.0f)};
}

}  // namespace lightloom::image::flip
