#pragma once

#include <vector>

#include "framework/study/study_folder.hpp"

namespace lightloom::study {

struct Judgement {
  MetricValues metrics;       ///< all of metric_names(), mean over the frames
  image::HostImage heat_map;  ///< FLIP of the last frame, rgba8_unorm, white at 1
};

/// Compares frame by frame; both lists have the same length, at least one. `threads` as in image::MetricOptions. Throws
/// Error(invalid_input) where sizes differ.
[[nodiscard]] Judgement judge(const std::vector<image::HostImage>& references,
                              const std::vector<image::HostImage>& tests, unsigned threads);

/// Matrix for split_error: entry i, j is the mean over pixels and colours of (x_i - r)(x_j - r); pixels where any image
/// is not finite are left out.
[[nodiscard]] std::vector<double> error_products(const image::HostImage& reference,
                                                 const std::vector<image::HostImage>& tests);

}  // namespace lightloom::study
