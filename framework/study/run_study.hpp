#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/gpu/device.hpp"
#include "framework/study/plan_study.hpp"
#include "framework/study/study_folder.hpp"

namespace lightloom::study {

/// How far a study is. Called from any of its threads, one at a time.
struct StudyProgress {
  size_t done = 0;  ///< references and cells, those found finished included
  size_t total = 0;
  std::optional<double> seconds_left;  ///< from the times of what is done, weighted by setting; empty before that
};
using ProgressCallback = std::function<void(const StudyProgress&)>;

/// Why rows could not be run, by index; reasons that a row had in the plan are not repeated.
struct RunProblems {
  std::map<size_t, std::string> rows;
  std::vector<std::string> warnings;
};

/// Which parts of the work are already in the folder.
struct StudyState {
  std::vector<bool> references;  ///< parallel to StudyPlan::references
  std::vector<bool> cells;       ///< parallel to StudyPlan::cells: rendered and judged
  [[nodiscard]] size_t missing() const;
};
[[nodiscard]] StudyState find_state(const StudyPlan& plan, const StudyFolder& folder);

/// What is missing takes so long [s], by the cells of the folder; empty where there is none to learn from.
[[nodiscard]] std::optional<double> time_needed(const StudyPlan& plan, const StudyFolder& folder);

/// Renders and judges what the folder does not hold yet, `plan.spec.jobs` at a time, each with a device of its own.
/// Each finished cell is kept at once. What fails is a problem of its row; the others go on. Throws Error where
/// there is no device.
[[nodiscard]] RunProblems run_study(const StudyPlan& plan, const StudyFolder& folder, const gpu::DeviceOptions& device,
                                    const ProgressCallback& on_progress);

}  // namespace lightloom::study
