#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "framework/graph/plan.hpp"
#include "framework/graph/share_memory.hpp"

namespace lightloom {

/// What is known of a plan beyond the plan itself; what is empty, nobody asked for.
struct PlanFacts {
  struct Memory {
    std::vector<MemoryNeed> needs;  ///< by value
    MemorySharing sharing;          ///< that the plan's takeovers belong to
  };
  struct Times {
    std::string run;              ///< the run folder they are from
    std::vector<double> step_ms;  ///< by step of a frame: median over the run's frames
  };
  std::optional<Memory> memory;
  std::optional<Times> times;
};

/// The plan as data, in the form that plan_schema describes: values, steps, barriers with their reasons, what was left
/// out and why. The same plan and facts give the same JSON.
[[nodiscard]] nlohmann::ordered_json plan_json(const Plan& plan, const PlanFacts& facts = {});

/// JSON Schema (2020-12) of what plan_json gives.
[[nodiscard]] nlohmann::ordered_json plan_schema();

}  // namespace lightloom
