#pragma once

#include <cstdint>

#include "framework/image/host_image.hpp"

namespace lightloom::image {

enum class FlipKind : uint8_t { ldr, hdr };

struct MetricOptions {
  FlipKind flip = FlipKind::hdr;
  double pixels_per_degree = 67.0206;  ///< of FLIP's viewer: 0.7 m from a 0.7 m wide screen of 3840 pixels; at least 1
  double epsilon = 1e-2;  ///< of relMSE and MAPE: what keeps their denominators from 0; the floor of fireflies; above 0
  double firefly_factor = 10;  ///< a firefly: luminance above this times the larger of the reference's and epsilon
  bool with_ssim = true;       ///< false leaves it NaN and saves its time
  bool with_flip = true;       ///< the same
  unsigned threads = 0;        ///< 0: as many as there are cores; the result is the same for any number
};

/// Errors of a test image T against a reference R, over all pixels and the three colour channels, linear radiance or
/// display values alike. Pixels with a NaN or an infinity in either are left out of all but `non_finite`; where no
/// pixel is left, all figures are NaN. Definitions and sources: docs/metrics.md.
struct Metrics {
  double mse = 0;         ///< mean of (T - R)^2
  double rmse = 0;        ///< its square root
  double psnr = 0;        ///< 10 log10(1 / mse) [dB], peak 1; infinite for equal images
  double relmse = 0;      ///< mean of (T - R)^2 / (R^2 + epsilon)
  double mape = 0;        ///< mean of |T - R| / (|R| + epsilon)
  double smape = 0;       ///< mean of 2 |T - R| / (|T| + |R|), 0..2, 0 where both are 0
  double ssim = 0;        ///< of luminance, 11x11 Gaussian of sigma 1.5, where the window lies within the image
  double flip = 0;        ///< mean FLIP, 0..1
  double mean_error = 0;  ///< mean of |T - R|
  double max_error = 0;   ///< largest |T - R|
  double bias = 0;        ///< mean of T - R: negative where the test is too dark
  uint64_t fireflies = 0;
  uint64_t non_finite = 0;            ///< pixels of the test with a NaN or an infinity
  uint64_t reference_non_finite = 0;  ///< pixels of the reference with one
  uint64_t clamped = 0;  ///< pixels with a value outside 0..1 in either, which FLIP of display values clamps; 0 for HDR
};

/// Both images two-dimensional with at least one pixel, of the same size, floats or unorm (taken as linear), with 1, 3
/// or 4 channels (alpha is left out; one channel counts as grey). Throws Error(invalid_input) otherwise, and for
/// options out of range.
[[nodiscard]] Metrics compare(const HostImage& reference, const HostImage& test, const MetricOptions& options = {});

/// FLIP of each pixel, r32_sfloat, 0..1; 0 where a pixel is left out.
[[nodiscard]] HostImage flip_map(const HostImage& reference, const HostImage& test, const MetricOptions& options = {});

/// Both at the price of one.
struct MetricsAndMap {
  Metrics metrics;
  HostImage flip_map;
};
[[nodiscard]] MetricsAndMap compare_with_flip_map(const HostImage& reference, const HostImage& test,
                                                  const MetricOptions& options = {});

/// |T - R| / (|R| + epsilon) of each pixel, mean over channels, r32_sfloat; NaN where a pixel is left out.
[[nodiscard]] HostImage relative_error_map(const HostImage& reference, const HostImage& test,
                                           const MetricOptions& options = {});

/// A map as colours (magma), rgba8_unorm: 0 is black, `white` (above 0) and above the brightest; NaN is green.
[[nodiscard]] HostImage heat_map(const HostImage& map, double white = 1);

}  // namespace lightloom::image
