#pragma once

#include <string>

#include "framework/graph/plan_json.hpp"

namespace lightloom::page {

/// A plan as one self-contained HTML page, which asks nothing of a network: order of the passes, lifetimes of values,
/// where they lie in memory, barriers with reasons, what was left out, and with times the critical path.
[[nodiscard]] std::string make_plan_page(const Plan& plan, const PlanFacts& facts = {});

}  // namespace lightloom::page
