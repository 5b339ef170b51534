#pragma once

#include <string>

#include "framework/graph/plan.hpp"

namespace lightloom {

/// The plan as a drawing for Graphviz (`dot -Tsvg`): passes as boxes in the order they run, what they write as
/// ellipses, one for each port; edges to readers, dashed where they read earlier frames. What runs once is in a box of
/// its own; what was culled or is off stands beside in grey, with the reason as its tooltip.
[[nodiscard]] std::string plan_dot(const Plan& plan);

}  // namespace lightloom
