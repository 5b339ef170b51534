#pragma once

#include <vector>

#include "framework/graph/share_memory.hpp"

namespace lightloom::toy {

/// What a device that has one kind of memory for volumes and another for pictures could say of a graph's values.
inline std::vector<MemoryNeed> needs_of(const Graph& graph) {
  std::vector<MemoryNeed> needs;
  for (const Value& value : graph.values) {
    const uint32_t kinds = value.desc.dimension == Dimension::d3 ? 1 : 3;
    needs.push_back({byte_size(value), 256, kinds});
  }
  return needs;
}

}  // namespace lightloom::toy
