#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

// FLIP once more, from the two papers alone: doubles, two-dimensional filters that are not separated, every pixel on
// its own. Shares nothing with framework/image.
namespace lightloom::image::oracle {

using Vector = std::array<double, 3>;

struct Picture {
  int width = 0, height = 0;
  std::vector<Vector> pixels;  ///< linear RGB

  [[nodiscard]] const Vector& at(int x, int y) const {
    return pixels[size_t(std::clamp(y, 0, height - 1)) * size_t(width) + size_t(std::clamp(x, 0, width - 1))];
  }
};

/// XYZ of linear RGB, from the chromaticities of the primaries: R, G and B contribute so that (1, 1, 1) has the
/// chromaticity of D65 and Y = 1. Solved by Cramer's rule.
inline Vector xyz(const Vector& rgb) {
  constexpr double kX[3] = {0.64, 0.30, 0.15}, kY[3] = {0.33, 0.60, 0.06};
  const Vector white = {0.3127 / 0.3290, 1, (1 - 0.3127 - 0.3290) / 0.3290};
  const auto column = [&](int i) { return Vector{kX[i], kY[i], 1 - kX[i] - kY[i]}; };
  const auto determinant = [](const Vector& a, const Vector& b, const Vector& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1]) + c[0] * (a[1] * b[2] - a[2] * b[1]);
  };
  const double all = determinant(column(0), column(1), column(2));
  const Vector strength = {determinant(white, column(1), column(2)) / all,
                           determinant(column(0), white, column(2)) / all,
                           determinant(column(0), column(1), white) / all};
  Vector result{};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) result[size_t(k)] += rgb[size_t(i)] * strength[size_t(i)] * column(i)[size_t(k)];
  return result;
}

/// Linear RGB of XYZ: the three unknowns by elimination.
inline Vector rgb_of(const Vector& target) {
  double m[3][4];
  for (size_t i = 0; i < 3; ++i) {
    Vector unit{};
    unit[i] = 1;
    const Vector column = xyz(unit);
    for (size_t k = 0; k < 3; ++k) m[k][i] = column[k];
  }
  for (size_t k = 0; k < 3; ++k) m[k][3] = target[k];
  for (size_t pivot = 0; pivot < 3; ++pivot)
    for (size_t row = 0; row < 3; ++row) {
      if (row == pivot) continue;
      const double factor = m[row][pivot] / m[pivot][pivot];
      for (size_t k = 0; k < 4; ++k) m[row][k] -= factor * m[pivot][k];
    }
  return {m[0][3] / m[0][0], m[1][3] / m[1][1], m[2][3] / m[2][2]};
}

inline Vector white_xyz() {
  return xyz({1, 1, 1});
}

inline Vector opponent(const Vector& rgb) {
  const Vector value = xyz(rgb), white = white_xyz();
  const double x = value[0] / white[0], y = value[1] / white[1], z = value[2] / white[2];
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

/// CIELAB with the Hunt effect.
inline Vector adjusted_lab(const Vector& rgb) {
  const Vector value = xyz(rgb), white = white_xyz();
  Vector f{};
  for (size_t k = 0; k < 3; ++k) {
    const double t = value[k] / white[k];
    f[k] = t > std::pow(6.0 / 29, 3) ? std::pow(t, 1.0 / 3) : t * 29 * 29 / (3.0 * 36) + 4.0 / 29;
  }
  const double lightness = 116 * f[1] - 16;
  return {lightness, lightness / 100 * 500 * (f[0] - f[1]), lightness / 100 * 200 * (f[1] - f[2])};
}

inline double distance(const Vector& a, const Vector& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

/// Weight of opponent channel `channel` at a distance of d pixels, not normalised.
inline double sensitivity(size_t channel, double squared_distance, double ppd) {
  const double pi = std::numbers::pi;
  const auto bell = [&](double a, double b) {
    return a * std::sqrt(pi / b) * std::exp(-pi * pi * squared_distance / (ppd * ppd) / b);
  };
  if (channel == 0) return bell(1, 0.0047);
  if (channel == 1) return bell(1, 0.0053);
  return bell(34.1, 0.04) + bell(13.5, 0.025);
}

inline Vector seen(const Picture& picture, int x, int y, double ppd) {
  const int radius = int(std::ceil(3 * std::sqrt(0.04 / (2 * std::numbers::pi * std::numbers::pi)) * ppd));
  Vector sum{}, weights{};
  for (int dy = -radius; dy <= radius; ++dy)
    for (int dx = -radius; dx <= radius; ++dx) {
      const Vector color = opponent(picture.at(x + dx, y + dy));
      for (size_t c = 0; c < 3; ++c) {
        const double weight = sensitivity(c, dx * dx + dy * dy, ppd);
        sum[c] += weight * color[c];
        weights[c] += weight;
      }
    }
  const Vector white = white_xyz();
  const double luminance = (sum[0] / weights[0] + 16) / 116;
  Vector rgb = rgb_of({(luminance + sum[1] / weights[1] / 500) * white[0], luminance * white[1],
                       (luminance - sum[2] / weights[2] / 200) * white[2]});
  for (double& channel : rgb) channel = std::clamp(channel, 0.0, 1.0);
  return adjusted_lab(rgb);
}

/// Gradient lengths {edge, point}.
inline std::array<double, 2> features(const Picture& picture, int x, int y, double ppd) {
  const double sigma = 0.5 * 0.082 * ppd;
  const int radius = int(std::ceil(3 * sigma));
  double plus[2] = {}, minus[2] = {};
  std::array<double, 4> positive{}, negative{};  // edge x, edge y, point x, point y
  for (int dy = -radius; dy <= radius; ++dy)
    for (int dx = -radius; dx <= radius; ++dx) {
      const double bell = std::exp(-(dx * dx + dy * dy) / (2 * sigma * sigma));
      const double grey = (opponent(picture.at(x + dx, y + dy))[0] + 16) / 116;
      const double weights[4] = {-dx * bell, -dy * bell, (dx * dx / (sigma * sigma) - 1) * bell,
                                 (dy * dy / (sigma * sigma) - 1) * bell};
      for (size_t k = 0; k < 4; ++k) (weights[k] > 0 ? positive : negative)[k] += weights[k] * grey;
      for (size_t k = 0; k < 2; ++k) (weights[2 * k] > 0 ? plus : minus)[k] += std::abs(weights[2 * k]);
    }
  const auto value = [&](size_t k) { return positive[k] / plus[k / 2] + negative[k] / minus[k / 2]; };
  return {std::hypot(value(0), value(1)), std::hypot(value(2), value(3))};
}

/// FLIP of display values, by pixel.
inline std::vector<double> flip_display(const Picture& reference, const Picture& test, double ppd) {
  const double most = std::pow(distance(adjusted_lab({0, 1, 0}), adjusted_lab({0, 0, 1})), 0.7);
  std::vector<double> errors;
  for (int y = 0; y < reference.height; ++y)
    for (int x = 0; x < reference.width; ++x) {
      const double difference = std::pow(distance(seen(reference, x, y, ppd), seen(test, x, y, ppd)), 0.7);
      const double color =
          difference < 0.4 * most ? 0.95 * difference / (0.4 * most) : 0.95 + 0.05 * (difference / most - 0.4) / 0.6;
      const auto of_reference = features(reference, x, y, ppd), of_test = features(test, x, y, ppd);
      const double feature = std::max(std::abs(of_reference[0] - of_test[0]), std::abs(of_reference[1] - of_test[1]));
      errors.push_back(std::pow(color, 1 - std::sqrt(feature / std::sqrt(2.0))));
    }
  return errors;
}

inline double aces(double x) {
  const double y = 0.6 * x;
  return y * (2.51 * y + 0.03) / (y * (2.43 * y + 0.59) + 0.14);
}

inline Picture exposed(const Picture& picture, double stops) {
  Picture result = picture;
  for (Vector& pixel : result.pixels)
    for (double& channel : pixel) channel = std::clamp(aces(channel * std::exp2(stops)), 0.0, 1.0);
  return result;
}

/// FLIP of radiance, for an even number of pixels, more than half of them lit.
inline std::vector<double> flip_radiance(const Picture& reference, const Picture& test, double ppd) {
  double level = 0;  // aces(level) = 0.85, by bisection
  for (double step = 64; step > 1e-12; step /= 2)
    if (aces(level + step) < 0.85) level += step;
  std::vector<double> luminances;
  for (const Vector& p : reference.pixels) luminances.push_back(0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]);
  std::sort(luminances.begin(), luminances.end());
  const double median = (luminances[luminances.size() / 2 - 1] + luminances[luminances.size() / 2]) / 2;
  const double start = std::log2(level / luminances.back()), stop = std::log2(level / median);
  const int count = std::max(2, int(std::ceil(stop - start)));
  std::vector<double> most(reference.pixels.size());
  for (int k = 0; k < count; ++k) {
    const double stops = start + (stop - start) * k / (count - 1);
    const std::vector<double> errors = flip_display(exposed(reference, stops), exposed(test, stops), ppd);
    for (size_t i = 0; i < most.size(); ++i) most[i] = std::max(most[i], errors[i]);
  }
  return most;
}

}  // namespace lightloom::image::oracle
