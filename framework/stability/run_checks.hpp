#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "framework/stability/check.hpp"

namespace lightloom::stability {

/// What came of a check.
struct Outcome {
  const Check* check = nullptr;
  std::vector<Figure> figures;
  std::string failure;  ///< what was thrown, or what the validation layers said; empty: nothing
  double seconds = 0;   ///< wall time
};

/// It measured something, each figure keeps its threshold, and nothing failed.
[[nodiscard]] bool passed(const Outcome& outcome);

/// Runs one check; never throws what the check throws, but Interrupted. Validation messages that came meanwhile are a
/// failure.
[[nodiscard]] Outcome run_check(const Check& check, Lab& lab);

/// The checks whose name or group fits one of the globs (all for no globs), slow ones only if `slow`, or if one of the
/// globs is their very name. Throws Error(usage) for a glob that fits none, with the closest names.
[[nodiscard]] std::vector<const Check*> choose_checks(std::span<const Check> checks,
                                                      const std::vector<std::string>& globs, bool slow);

}  // namespace lightloom::stability
