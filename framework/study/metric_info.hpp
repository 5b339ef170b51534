#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lightloom::study {

/// What a reader must know of one metric of image::Metrics.
struct MetricInfo {
  std::string name;   ///< as in Row::metrics
  std::string label;  ///< "FLIP"
  std::string unit;   ///< "dB"; "" for a pure number
  bool higher_is_better = false;
  bool nearest_zero_is_best = false;  ///< signed: bias
  std::string doc;                    ///< one sentence
};

/// Of an unknown name: label = name, lower is better.
[[nodiscard]] MetricInfo metric_info(std::string_view name);

/// Place of a metric in the order in which a reader wants them; unknown ones come last.
[[nodiscard]] size_t metric_rank(std::string_view name);

/// True if the value `a` of the metric is strictly better than `b`. NaN is worse than any number.
[[nodiscard]] bool is_better(const MetricInfo& metric, double a, double b);

}  // namespace lightloom::study
