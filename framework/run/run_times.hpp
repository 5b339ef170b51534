#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/graph/plan.hpp"

namespace lightloom::run {

/// What a run folder says of how long the steps of a plan take.
struct RunTimes {
  std::vector<double> step_ms;  ///< by Plan::steps: median over the run's frames
  bool same_plan = true;        ///< the run's plan has the hash of this one
};

/// Reads `folder`/run.json. Throws Error(invalid_input) where that is missing or no record of a run, and where it has
/// no time of a pass that the plan runs.
[[nodiscard]] RunTimes read_run_times(const std::filesystem::path& folder, const Plan& plan);

}  // namespace lightloom::run
