#include "framework/graph/plan.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "framework/graph/serialise.hpp"
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

/// What frames go on from before there were any: constants, rings, and what their passes keep.
void add_clears(Plan& plan) {
  for (ValueId id = 0; id < plan.graph.values.size(); ++id) {
    const Value& value = plan.graph.values[id];
    if (value.constant || value.history > 0 || value.persistent)
      plan.prologue.push_back({id, value.constant.value_or(ClearColor{0, 0, 0, 0})});
  }
}

void add_scans(const Graph& graph, std::vector<PlanStep>& steps) {
  for (PlanStep& step : steps)
    for (const auto* uses : {&graph.passes[step.pass].outputs, &graph.passes[step.pass].scratch})
      for (const Use& use : *uses) step.observations.push_back({use.value, 0, Observer::scan, {}});
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

std::string_view to_string(SyncPolicy policy) {
  return policy == SyncPolicy::conservative ? "conservative" : "minimal";
}

std::string barrier_subject(const Graph& graph, ValueId value) {
  if (value == kFrameInputs) return "frame inputs";
  return value == kEverything ? "everything" : value_name(graph.values[value]);
}

Access access_of(Observer /*observer*/) {
  // A scan searches a copy: raw bits, which no conversion on the way to a shader has touched.
  return Access::transfer_read;
}

std::string_view to_string(Observer observer) {
  return observer == Observer::scan ? "the scan" : "the read-back";
}

Plan compile(const Graph& graph, const CompileOptions& options) {
  Plan plan;
  plan.graph = graph;
  std::vector<std::optional<uint32_t>> producer_step(graph.values.size());
  for (const uint32_t index : schedule(graph, options.order, options.order_seed).order) {
    const GraphPass& pass = graph.passes[index];
    (pass.once.empty() ? plan.steps : plan.once).push_back({index, {}, {}});
    if (!pass.once.empty()) continue;
    const auto step = static_cast<uint32_t>(plan.steps.size() - 1);
    for (const Use& use : pass.outputs) producer_step[use.value] = step;
    for (const Use& use : pass.scratch) producer_step[use.value] = step;
  }
  for (const auto& [value, age] : observed(graph)) {
    const std::optional<uint32_t> step = producer_step[value];
    (step ? plan.steps[*step].observations : plan.opening_observations)
        .push_back({value, age, Observer::read_back, {}});
  }
  if (options.scan) {
    add_scans(graph, plan.once);
    add_scans(graph, plan.steps);
  }
  add_clears(plan);
  if (options.sync == SyncPolicy::conservative)
    serialise(plan);
  else
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
