#pragma once

#include <cstdint>
#include <vector>

#include "framework/graph/graph.hpp"

namespace lightloom {

struct Schedule {
  std::vector<uint32_t> order;   ///< indices into Graph::passes, in execution order
  std::vector<uint32_t> levels;  ///< of the passes by index; a pass is one level above the highest of its sources
};

/// As soon as possible by level, then in declared order. History edges order nothing. The graph must be free of
/// cycles, which `link` guarantees.
[[nodiscard]] Schedule schedule(const Graph& graph);

}  // namespace lightloom
