#pragma once

#include "framework/gpu/device.hpp"
#include "framework/study/plan_study.hpp"
#include "framework/study/results.hpp"
#include "framework/study/run_study.hpp"
#include "framework/study/study_folder.hpp"

namespace lightloom::study {

/// Stands among the notes where times are disturbed.
constexpr const char* kDisturbedNote = "Cells ran at the same time and disturbed each other: their times say little";

/// Figures out of finished cells. Copies the pictures that the results name into `pictures/` of the folder.
[[nodiscard]] StudyResults evaluate(const StudyPlan& plan, const StudyFolder& folder, const RunProblems& problems,
                                    const gpu::DeviceInfo& device);

/// One cell, for cells.csv.
struct CellResult {
  size_t row = 0;  ///< of the results
  uint32_t seed = 0;
  std::string key;
  MetricValues metrics;
  double frame_ms = 0;  ///< median
  double wall_ms = 0;   ///< median
};
[[nodiscard]] std::vector<CellResult> cell_results(const StudyPlan& plan, const StudyFolder& folder,
                                                   const StudyResults& results);

}  // namespace lightloom::study
