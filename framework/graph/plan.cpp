#include "framework/graph/plan.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "framework/graph/schedule.hpp"
#include "framework/graph/synchronise.hpp"

namespace lightloom {
namespace {

/// What is observed: outputs and captures, each value and age once, in order of the values.
std::vector<std::pair<ValueId, uint32_t>> observed(const Graph& graph) {
  std::vector<std::pair<ValueId, uint32_t>> result;
  for (const GraphOutput& output : graph.outputs) {
    // A constant has one layer, whatever the age.
    result.emplace_back(output.value, graph.values[output.value].constant ? 0 : output.age);
  }
  for (const ValueId value : graph.captures) result.emplace_back(value, 0);
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

}  // namespace

std::string_view to_string(Hazard hazard) {
  switch (hazard) {
    case Hazard::read_after_write:
      return "read after write";
    case Hazard::write_after_read:
      return "write after read";
    case Hazard::write_after_write:
      break;
  }
  return "write after write";
}

Plan compile(const Graph& graph) {
  Plan plan;
  plan.graph = graph;
  std::vector<std::optional<uint32_t>> producer_step(graph.values.size());
  for (const uint32_t index : schedule(graph).order) {
    const GraphPass& pass = graph.passes[index];
    (pass.once.empty() ? plan.steps : plan.once).push_back({index, {}, {}});
    if (!pass.once.empty()) continue;
    const auto step = static_cast<uint32_t>(plan.steps.size() - 1);
    for (const Use& use : pass.outputs) producer_step[use.value] = step;
    for (const Use& use : pass.scratch) producer_step[use.value] = step;
  }
  for (const auto& [value, age] : observed(graph)) {
    const std::optional<uint32_t> step = producer_step[value];
    (step ? plan.steps[*step].copies : plan.opening_copies).push_back({value, age, {}});
  }
  synchronise(plan);
  return plan;
}

MemoryUse memory_use(const Graph& graph) {
  MemoryUse use;
  for (const Value& value : graph.values) {
    use.total += byte_size(value);
    if (ring_layers(value) > 1) use.rings += byte_size(value);
  }
  return use;
}

}  // namespace lightloom
