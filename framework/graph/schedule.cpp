#include "framework/graph/schedule.hpp"

#include <algorithm>
#include <numeric>

namespace lightloom {

Schedule schedule(const Graph& graph) {
  const auto count = static_cast<uint32_t>(graph.passes.size());
  std::vector<uint32_t> producer(graph.values.size(), count);
  for (uint32_t i = 0; i < count; ++i)
    for (const Use& use : graph.passes[i].outputs) producer[use.value] = i;

  // A pass is settled once all that it reads this frame is; in a graph without cycles each round settles one at least.
  Schedule result;
  result.levels.assign(count, 0);
  bool changed = true;
  for (uint32_t round = 0; changed && round < count; ++round) {
    changed = false;
    for (uint32_t i = 0; i < count; ++i) {
      for (const Use& use : graph.passes[i].inputs) {
        if (use.first_age > 0 || producer[use.value] == count) continue;
        const uint32_t level = result.levels[producer[use.value]] + 1;
        changed = changed || level > result.levels[i];
        result.levels[i] = std::max(result.levels[i], level);
      }
    }
  }
  result.order.resize(count);
  std::iota(result.order.begin(), result.order.end(), 0U);
  std::stable_sort(result.order.begin(), result.order.end(),
                   [&](uint32_t a, uint32_t b) { return result.levels[a] < result.levels[b]; });
  return result;
}

}  // namespace lightloom
