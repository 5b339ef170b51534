#include "framework/image/flip_filters.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace lightloom::image::flip {
namespace {

/// a sqrt(pi / b) exp(-pi^2 d^2 / b), d in degrees: the Fourier transform of a contrast sensitivity function that is a
/// Gaussian of frequency.
struct SensitivityGaussian {
  double a, b;
};
constexpr SensitivityGaussian kAchromatic = {1, 0.0047};
constexpr SensitivityGaussian kRedGreen = {1, 0.0053};
constexpr SensitivityGaussian kBlueYellowWide = {34.1, 0.04};
constexpr SensitivityGaussian kBlueYellowNarrow = {13.5, 0.025};

constexpr double kFeatureWidth = 0.082;  // of the widest edge that counts as a feature [degrees]
constexpr double kCut = 3;               // filters end at this many standard deviations

/// Weights of the offsets 0 to `radius` [pixels].
using Half = std::vector<double>;

Half make_half(int radius, const std::function<double(double)>& weight) {
  Half half;
  for (int offset = 0; offset <= radius; ++offset) half.push_back(weight(offset));
  return half;
}

/// Of all weights, those on the other side included.
double sum_of(const Half& half) {
  double sum = -half.front();
  for (const double weight : half) sum += 2 * weight;
  return sum;
}

Kernel make_kernel(Kernel::Form form, const Half& half, double factor) {
  Kernel kernel{form, static_cast<float>(half.front() * factor), {}};
  for (size_t k = 1; k < half.size(); ++k) kernel.side.push_back(static_cast<float>(half[k] * factor));
  return kernel;
}

Kernel make_mean(const Half& half) {
  return make_kernel(Kernel::Form::mean, half, 1 / sum_of(half));
}

/// x times the bell: the weights of one side sum to 1, those of the other to -1.
Kernel make_slope(Half half) {
  double sum = 0;
  for (const double weight : half) sum += weight;
  return make_kernel(Kernel::Form::slope, half, 1 / sum);
}

/// Positive weights, on both sides, to sum 1. The negative ones, about the middle, sum to -1 as FLIP wants it: they are
/// scaled on their own, and the middle's takes part by the differences to it.
Kernel make_curvature(Half half) {
  double positive = 0, negative = 0;
  for (size_t k = 0; k < half.size(); ++k) {
    const double weight = (k == 0 ? 1 : 2) * half[k];
    (weight > 0 ? positive : negative) += std::abs(weight);
  }
  for (double& weight : half) weight /= weight > 0 ? positive : negative;
  return make_kernel(Kernel::Form::curvature, half, 1);
}

/// Square root of the two-dimensional Gaussian's height, so that the product of two of them has that height.
Half sensitivity(const SensitivityGaussian& gaussian, int radius, double pixels_per_degree) {
  const double height = std::sqrt(gaussian.a * std::sqrt(std::numbers::pi / gaussian.b));
  return make_half(radius, [&](double offset) {
    const double degrees = offset / pixels_per_degree;
    return height * std::exp(-std::numbers::pi * std::numbers::pi * degrees * degrees / gaussian.b);
  });
}

void add_sensitivity(double pixels_per_degree, Filters& filters) {
  const double widest = std::sqrt(kBlueYellowWide.b / (2 * std::numbers::pi * std::numbers::pi));  // [degrees]
  const int radius = static_cast<int>(std::ceil(kCut * widest * pixels_per_degree));
  filters.achromatic = make_mean(sensitivity(kAchromatic, radius, pixels_per_degree));
  filters.red_green = make_mean(sensitivity(kRedGreen, radius, pixels_per_degree));
  const Half wide = sensitivity(kBlueYellowWide, radius, pixels_per_degree);
  const Half narrow = sensitivity(kBlueYellowNarrow, radius, pixels_per_degree);
  const double factor = 1 / std::hypot(sum_of(wide), sum_of(narrow));
  filters.blue_yellow_wide = make_kernel(Kernel::Form::mean, wide, factor);
  filters.blue_yellow_narrow = make_kernel(Kernel::Form::mean, narrow, factor);
}

void add_features(double pixels_per_degree, Filters& filters) {
  const double sigma = 0.5 * kFeatureWidth * pixels_per_degree;  // [pixels]
  const int radius = static_cast<int>(std::ceil(kCut * sigma));
  const auto bell = [sigma](double x) { return std::exp(-x * x / (2 * sigma * sigma)); };
  filters.gaussian = make_mean(make_half(radius, bell));
  filters.edge = make_slope(make_half(radius, [&](double x) { return x * bell(x); }));
  filters.point = make_curvature(make_half(radius, [&](double x) { return (x * x / (sigma * sigma) - 1) * bell(x); }));
}

}  // namespace

Filters make_filters(double pixels_per_degree) {
  Filters filters;
  add_sensitivity(pixels_per_degree, filters);
  add_features(pixels_per_degree, filters);
  return filters;
}

}  // namespace lightloom::image::flip
