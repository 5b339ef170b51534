#include "framework/image/metrics.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <span>

#include "framework/base/error.hpp"
#include "framework/image/classic_errors.hpp"
#include "framework/image/compared_images.hpp"
#include "framework/image/flip.hpp"
#include "framework/image/ssim.hpp"

namespace lightloom::image {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

void require_valid(const MetricOptions& options) {
  const auto require = [](bool good, const char* name, const char* range, double value) {
    if (good) return;
    throw Error(ExitCode::invalid_input, std::string(name) + " must be " + range + ", and is " + std::to_string(value));
  };
  require(std::isfinite(options.pixels_per_degree) && options.pixels_per_degree >= 1, "pixels_per_degree",
          "a number of at least 1", options.pixels_per_degree);
  require(std::isfinite(options.epsilon) && options.epsilon > 0, "epsilon", "a number above 0", options.epsilon);
  require(std::isfinite(options.firefly_factor) && options.firefly_factor > 0, "firefly_factor", "a number above 0",
          options.firefly_factor);
}

HostImage map_image(const ComparedImages& images, std::span<const float> values) {
  HostImage map;
  map.desc = {Format::r32_sfloat, Dimension::d2, {images.reference.width, images.reference.height, 1}};
  map.texels.resize(values.size_bytes());
  std::memcpy(map.texels.data(), values.data(), values.size_bytes());
  return map;
}

double mean_flip(const ComparedImages& images, const std::vector<float>& map) {
  double sum = 0;
  for (const float error : map) sum += static_cast<double>(error);
  return sum / static_cast<double>(images.usable_count);
}

bool out_of_range(const Planes& planes, size_t pixel) {
  const auto outside = [pixel](const std::vector<float>& channel) { return channel[pixel] < 0 || channel[pixel] > 1; };
  return outside(planes.channels[0]) || outside(planes.channels[1]) || outside(planes.channels[2]);
}

uint64_t count_clamped(const ComparedImages& images) {
  uint64_t count = 0;
  for (size_t pixel = 0; pixel < images.reference.pixel_count(); ++pixel)
    if (out_of_range(images.reference, pixel) || out_of_range(images.test, pixel)) ++count;
  return count;
}

Metrics without_pixels() {
  Metrics metrics;
  for (double* figure : {&metrics.mse, &metrics.rmse, &metrics.psnr, &metrics.relmse, &metrics.mape, &metrics.smape,
                         &metrics.ssim, &metrics.flip, &metrics.mean_error, &metrics.max_error, &metrics.bias})
    *figure = kNan;
  return metrics;
}

/// `flip_map` may be empty: then there is no figure of FLIP.
Metrics figures(const ComparedImages& images, const MetricOptions& options, const std::vector<float>& flip_map) {
  Metrics metrics;
  if (images.usable_count == 0) {
    metrics = without_pixels();
  } else {
    add_classic_errors(images, options, metrics);
    metrics.ssim = options.with_ssim ? mean_ssim(images, options.threads) : kNan;
    metrics.flip = flip_map.empty() ? kNan : mean_flip(images, flip_map);
  }
  metrics.non_finite = images.non_finite;
  metrics.reference_non_finite = images.reference_non_finite;
  if (options.flip == FlipKind::ldr && !flip_map.empty()) metrics.clamped = count_clamped(images);
  return metrics;
}

}  // namespace

Metrics compare(const HostImage& reference, const HostImage& test, const MetricOptions& options) {
  require_valid(options);
  const ComparedImages images = pair_images(reference, test);
  return figures(images, options, options.with_flip ? flip::error_map(images, options) : std::vector<float>());
}

HostImage flip_map(const HostImage& reference, const HostImage& test, const MetricOptions& options) {
  require_valid(options);
  const ComparedImages images = pair_images(reference, test);
  return map_image(images, flip::error_map(images, options));
}

MetricsAndMap compare_with_flip_map(const HostImage& reference, const HostImage& test, const MetricOptions& options) {
  require_valid(options);
  const ComparedImages images = pair_images(reference, test);
  const std::vector<float> map = flip::error_map(images, options);
  return {figures(images, options, map), map_image(images, map)};
}

HostImage relative_error_map(const HostImage& reference, const HostImage& test, const MetricOptions& options) {
  require_valid(options);
  const ComparedImages images = pair_images(reference, test);
  std::vector<float> map(images.usable.size(), std::numeric_limits<float>::quiet_NaN());
  for (size_t pixel = 0; pixel < map.size(); ++pixel) {
    if (images.usable[pixel] == 0) continue;
    double sum = 0;
    for (size_t c = 0; c < 3; ++c) {
      const auto expected = static_cast<double>(images.reference.channels[c][pixel]);
      const auto found = static_cast<double>(images.test.channels[c][pixel]);
      sum += std::abs(found - expected) / (std::abs(expected) + options.epsilon);
    }
    map[pixel] = static_cast<float>(sum / 3);
  }
  return map_image(images, map);
}

}  // namespace lightloom::image
