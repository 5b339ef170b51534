#include "framework/study/metric_info.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lightloom::study {
namespace {

const std::array<MetricInfo, 15>& known_metrics() {
  static const std::array<MetricInfo, 15> metrics = {{
      {"flip", "FLIP", "", false, false, "Difference that a person sees when flipping between the pictures, 0 to 1."},
      {"relmse", "relMSE", "", false, false, "Mean squared error relative to the reference's squared radiance."},
      {"mse", "MSE", "", false, false, "Mean squared error of linear radiance."},
      {"rmse", "RMSE", "", false, false, "Root of the mean squared error of linear radiance."},
      {"mape", "MAPE", "", false, false, "Mean absolute error relative to the reference."},
      {"smape", "SMAPE", "", false, false, "Symmetric mean absolute error, 0 to 2: fireflies hardly move it."},
      {"psnr", "PSNR", "dB", true, false, "Peak signal-to-noise ratio, peak 1; infinite for equal pictures."},
      {"ssim", "SSIM", "", true, false, "Structural similarity of luminance, 1 for equal pictures."},
      {"mean_error", "mean error", "", false, false, "Mean absolute error of linear radiance."},
      {"max_error", "max error", "", false, false, "Largest absolute error of a channel."},
      {"bias", "bias", "", false, true, "Mean of picture minus reference: negative where it is too dark."},
      {"fireflies", "fireflies", "px", false, false, "Pixels that are far brighter than the reference."},
      {"non_finite", "NaN or Inf", "px", false, false, "Pixels that hold no number."},
      {"bias_squared", "bias²", "", false, false,
       "Squared error that no number of seeds averages away, corrected for the seeds' noise: it may fall below 0."},
      {"variance", "variance", "", false, false, "Mean over pixels of the variance over seeds."},
  }};
  return metrics;
}

}  // namespace

MetricInfo metric_info(std::string_view name) {
  const auto& metrics = known_metrics();
  const auto found = std::find_if(metrics.begin(), metrics.end(), [&](const MetricInfo& m) { return m.name == name; });
  if (found != metrics.end()) return *found;
  return MetricInfo{std::string(name), std::string(name), "", false, false, ""};
}

size_t metric_rank(std::string_view name) {
  const auto& metrics = known_metrics();
  const auto found = std::find_if(metrics.begin(), metrics.end(), [&](const MetricInfo& m) { return m.name == name; });
  return static_cast<size_t>(found - metrics.begin());
}

bool is_better(const MetricInfo& metric, double a, double b) {
  if (std::isnan(a)) return false;
  if (std::isnan(b)) return true;
  if (metric.nearest_zero_is_best) return std::abs(a) < std::abs(b);
  return metric.higher_is_better ? a > b : a < b;
}

}  // namespace lightloom::study
