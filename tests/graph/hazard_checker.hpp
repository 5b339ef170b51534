#pragma once

#include <string>
#include <vector>

#include "framework/graph/plan.hpp"

namespace lightloom {

/// Checks a plan by another method than the synthesis: plays enough frames for every ring to go round, as a flat
/// list of accesses to physical layers and of barriers, and demands for each conflicting pair of accesses to one layer
/// a chain of barriers on that image between them, by Vulkan's scopes. Barriers on other images do not count, which is
/// stricter than Vulkan. It also demands that each read of age a finds what was written a frames ago, and that nothing
/// undefined is read. Returns a sentence for each violation, at most `limit`.
[[nodiscard]] std::vector<std::string> find_hazards(const Plan& plan, std::size_t limit = 8);

}  // namespace lightloom
