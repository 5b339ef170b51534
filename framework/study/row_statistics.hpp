#pragma once

#include <vector>

#include "framework/graph/plan.hpp"
#include "framework/study/results.hpp"
#include "framework/study/study_folder.hpp"

namespace lightloom::study {

/// What was measured of a row, seed by seed.
struct RowSamples {
  std::vector<CellRecord> cells;
  std::vector<MetricValues> metrics;
};

/// Sum over passes of each timed frame [ms]; empty where the device has no timestamps.
[[nodiscard]] std::vector<double> frame_times(const CellTimes& times, uint32_t warm_up);
/// Median of those of each seed.
[[nodiscard]] std::vector<double> frame_medians(const RowSamples& samples, uint32_t warm_up);
[[nodiscard]] std::vector<double> values_of(const RowSamples& samples, const std::string& metric);

/// Times, memory and metrics of a row.
void fill_measurements(Row& row, const RowSamples& samples, const std::vector<std::string>& metrics, uint32_t warm_up);

/// Row against the baseline's row of its view; by metric and "frame_ms".
void fill_verdicts(Row& row, const RowSamples& samples, const RowSamples& baseline,
                   const std::vector<std::string>& metrics, uint32_t warm_up);

/// Passes that are disabled, and passes that are gone besides, each against the baseline's plan.
void fill_missing_passes(Row& row, const Plan& plan, const Plan& baseline);

}  // namespace lightloom::study
