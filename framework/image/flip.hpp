#pragma once

#include <vector>

#include "framework/image/compared_images.hpp"
#include "framework/image/metrics.hpp"

namespace lightloom::image::flip {

/// FLIP by pixel, 0 where a pixel is not usable. Negative values count as 0; for display values those above 1 as 1.
[[nodiscard]] std::vector<float> error_map(const ComparedImages& images, const MetricOptions& options);

/// Exposures [log2] at which FLIP of radiance looks at the images (EG 2021, section 4): from that at which the
/// reference's brightest pixel is tone mapped to 0.85 to that at which its median luminance is, at most one stop
/// apart, at least two. Black pixels do not count for the median where it would be 0; empty where all are black. They
/// depend on the reference alone.
[[nodiscard]] std::vector<double> exposures(const ComparedImages& images);

}  // namespace lightloom::image::flip
