#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "framework/graph/graph.hpp"

namespace lightloom {

/// In which order passes run; any of them keeps every producer before its readers of the same frame.
enum class PassOrder : uint8_t {
  level,     ///< as soon as possible, then as declared
  declared,  ///< as declared, as far as producers allow
  random,    ///< drawn by a seed
};

/// "level", "declared", "random:SEED".
[[nodiscard]] std::string to_string(PassOrder order, uint64_t seed);

struct Schedule {
  std::vector<uint32_t> order;   ///< indices into Graph::passes, in execution order
  std::vector<uint32_t> levels;  ///< of the passes by index; a pass is one level above the highest of its sources
};

/// History edges order nothing. `seed` is of PassOrder::random, which draws the same on every machine. The graph must
/// be free of cycles, which `link` guarantees.
[[nodiscard]] Schedule schedule(const Graph& graph, PassOrder order = PassOrder::level, uint64_t seed = 0);

}  // namespace lightloom
