#pragma once

#include "framework/image/compared_images.hpp"
#include "framework/image/metrics.hpp"

namespace lightloom::image {

/// Fills in the figures that are sums over pixels: mse, rmse, psnr, relmse, mape, smape, mean_error, bias, max_error
/// and fireflies. At least one pixel must be usable.
void add_classic_errors(const ComparedImages& images, const MetricOptions& options, Metrics& metrics);

}  // namespace lightloom::image
