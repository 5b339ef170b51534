#pragma once

#include <array>
#include <string_view>

#include "framework/image/metrics.hpp"

namespace lightloom::image {

/// A figure by its name in JSON and on command lines.
struct NamedMetric {
  std::string_view name;
  double (*value)(const Metrics&);
  std::string_view doc;  ///< what it is, with its unit where it has one
  bool higher_is_better = false;
};

/// All that `lightloom compare` prints, in its order.
constexpr std::array<NamedMetric, 13> kNamedMetrics = {{
    {"mse", [](const Metrics& m) { return m.mse; }, "mean of (T - R)^2"},
    {"rmse", [](const Metrics& m) { return m.rmse; }, "square root of mse"},
    {"psnr", [](const Metrics& m) { return m.psnr; }, "10 log10(1 / mse) [dB]", true},
    {"relmse", [](const Metrics& m) { return m.relmse; }, "mean of (T - R)^2 / (R^2 + epsilon)"},
    {"mape", [](const Metrics& m) { return m.mape; }, "mean of |T - R| / (|R| + epsilon)"},
    {"smape", [](const Metrics& m) { return m.smape; }, "mean of 2 |T - R| / (|T| + |R|), 0..2"},
    {"ssim", [](const Metrics& m) { return m.ssim; }, "structural similarity of luminance, 1 for equal images", true},
    {"flip", [](const Metrics& m) { return m.flip; }, "mean FLIP, 0..1"},
    {"mean_error", [](const Metrics& m) { return m.mean_error; }, "mean of |T - R|"},
    {"max_error", [](const Metrics& m) { return m.max_error; }, "largest |T - R|"},
    {"fireflies", [](const Metrics& m) { return static_cast<double>(m.fireflies); },
     "pixels far brighter than the reference's"},
    {"non_finite", [](const Metrics& m) { return static_cast<double>(m.non_finite); },
     "pixels of T with a NaN or an infinity"},
    {"bias", [](const Metrics& m) { return m.bias; }, "mean of T - R; negative: too dark"},
}};

}  // namespace lightloom::image
