#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "framework/graph/plan.hpp"

namespace lightloom {

/// How fast a frame could be if passes that need nothing of one another ran at the same time and took as long as alone.
/// Only what passes read of this frame's values orders them here; sharing memory and having one device can but add.
struct CriticalPath {
  double sum_ms = 0;                ///< of all steps of a frame, one after another
  double length_ms = 0;             ///< of the longest chain of steps that wait for one another: no overlap gets below
  std::vector<uint32_t> steps;      ///< that chain, in order; indices into Plan::steps
  std::vector<double> earliest_ms;  ///< by step: when it could begin, with the frame's first step at 0
};

/// By step, those whose values of this frame it reads, ascending.
[[nodiscard]] std::vector<std::vector<uint32_t>> steps_before(const Plan& plan);

/// `step_ms`: how long each of Plan::steps takes. The path is the first of equals.
[[nodiscard]] CriticalPath critical_path(const Plan& plan, std::span<const double> step_ms);

/// "critical path 12.1 ms of 14.0 ms: overlapping passes can save at most 1.9 ms (13.6 %)" and the path, on lines.
[[nodiscard]] std::string print_critical_path(const Plan& plan, std::span<const double> step_ms);

}  // namespace lightloom
