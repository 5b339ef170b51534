#include "framework/image/classic_errors.hpp"

#include <algorithm>
#include <cmath>

namespace lightloom::image {
namespace {

struct Sums {
  double squared = 0;
  double relative_squared = 0;
  double relative = 0;
  double symmetric = 0;
  double magnitude = 0;
  double signed_error = 0;

  void add(double reference, double test, double epsilon) {
    const double error = test - reference;
    const double size = std::abs(error);
    const double both = std::abs(reference) + std::abs(test);
    squared += error * error;
    relative_squared += error * error / (reference * reference + epsilon);
    relative += size / (std::abs(reference) + epsilon);
    symmetric += both > 0 ? 2 * size / both : 0;
    magnitude += size;
    signed_error += error;
  }
  void operator+=(const Sums& other) {
    squared += other.squared;
    relative_squared += other.relative_squared;
    relative += other.relative;
    symmetric += other.symmetric;
    magnitude += other.magnitude;
    signed_error += other.signed_error;
  }
};

bool is_firefly(const ComparedImages& images, size_t pixel, const MetricOptions& options) {
  const double allowed = options.firefly_factor * std::max(luminance(images.reference, pixel), options.epsilon);
  return luminance(images.test, pixel) > allowed;
}

}  // namespace

void add_classic_errors(const ComparedImages& images, const MetricOptions& options, Metrics& metrics) {
  Sums sums;
  const size_t width = images.reference.width;
  for (size_t row = 0; row < images.reference.height; ++row) {
    Sums of_row;  // rows apart, so that large images lose no digits
    for (size_t pixel = row * width; pixel < (row + 1) * width; ++pixel) {
      if (images.usable[pixel] == 0) continue;
      for (size_t c = 0; c < 3; ++c) {
        const auto reference = static_cast<double>(images.reference.channels[c][pixel]);
        const auto test = static_cast<double>(images.test.channels[c][pixel]);
        of_row.add(reference, test, options.epsilon);
        metrics.max_error = std::max(metrics.max_error, std::abs(test - reference));
      }
      if (is_firefly(images, pixel, options)) ++metrics.fireflies;
    }
    sums += of_row;
  }
  const double count = 3 * static_cast<double>(images.usable_count);
  metrics.mse = sums.squared / count;
  metrics.rmse = std::sqrt(metrics.mse);
  metrics.psnr = -10 * std::log10(metrics.mse);
  metrics.relmse = sums.relative_squared / count;
  metrics.mape = sums.relative / count;
  metrics.smape = sums.symmetric / count;
  metrics.mean_error = sums.magnitude / count;
  metrics.bias = sums.signed_error / count;
}

}  // namespace lightloom::image
