#include <algorithm>
#include <deque>

#include "framework/graph/link_state.hpp"

namespace lightloom::linking {
namespace {

/// Passes that run, and which reads this frame's values of which.
struct Flow {
  std::vector<std::vector<uint32_t>> consumers;
  std::vector<uint32_t> source_count;
};

template <class Visit>
void for_each_source(const std::vector<ResolvedInput>& inputs, Visit visit) {
  for (const ResolvedInput& input : inputs)
    for (const Source& source : input.sources)
      if (!source.constant && source.first_age == 0) visit(source.image.node, input);
}

Flow build_flow(const Wiring& wiring) {
  Flow flow;
  flow.consumers.resize(wiring.inputs.size());
  flow.source_count.resize(wiring.inputs.size());
  for (uint32_t i = 0; i < wiring.inputs.size(); ++i) {
    for_each_source(wiring.inputs[i], [&](uint32_t source, const ResolvedInput& /*input*/) {
      flow.consumers[source].push_back(i);
      ++flow.source_count[i];
    });
  }
  return flow;
}

/// Nodes on a cycle or behind one.
std::vector<bool> not_orderable(Flow flow) {
  std::vector<bool> left(flow.source_count.size(), true);
  std::deque<uint32_t> ready;
  for (uint32_t i = 0; i < flow.source_count.size(); ++i)
    if (flow.source_count[i] == 0) ready.push_back(i);
  for (; !ready.empty(); ready.pop_front()) {
    left[ready.front()] = false;
    for (const uint32_t consumer : flow.consumers[ready.front()])
      if (--flow.source_count[consumer] == 0) ready.push_back(consumer);
  }
  return left;
}

/// A shortest way from `start` back to it, both ends included; empty if there is none.
std::vector<uint32_t> shortest_cycle(const Flow& flow, uint32_t start) {
  std::vector<uint32_t> came_from(flow.consumers.size(), kNoNode);
  std::deque<uint32_t> queue{start};
  for (; !queue.empty(); queue.pop_front()) {
    for (const uint32_t next : flow.consumers[queue.front()]) {
      if (came_from[next] != kNoNode) continue;
      came_from[next] = queue.front();
      if (next != start) {
        queue.push_back(next);
        continue;
      }
      std::vector<uint32_t> cycle{start};
      for (uint32_t node = came_from[start]; node != start; node = came_from[node]) cycle.push_back(node);
      cycle.push_back(start);
      std::reverse(cycle.begin(), cycle.end());
      return cycle;
    }
  }
  return {};
}

void report_cycle(const Nodes& nodes, const Wiring& wiring, const std::vector<uint32_t>& cycle, Report& report) {
  const EdgeSpec* edge = nullptr;
  for_each_source(wiring.inputs[cycle.front()], [&](uint32_t source, const ResolvedInput& input) {
    if (source == cycle[cycle.size() - 2] && edge == nullptr) edge = input.edge;
  });
  std::string text;
  for (const uint32_t node : cycle) text += (text.empty() ? "" : " -> ") + nodes.list[node].spec->name;
  report.error("cycle", edge->where, "passes wait for each other: " + text,
               "to take the value of the previous frame, write \"" + edge->text + "@1\" in '" +
                   nodes.list[cycle.front()].spec->name + "' or break the cycle elsewhere");
}

}  // namespace

bool check_cycles(const Nodes& nodes, const Wiring& wiring, Report& report) {
  const Flow flow = build_flow(wiring);
  const std::vector<bool> left = not_orderable(flow);
  std::vector<bool> reported(left.size(), false);
  for (uint32_t i = 0; i < left.size(); ++i) {
    if (!left[i] || reported[i]) continue;
    const std::vector<uint32_t> cycle = shortest_cycle(flow, i);
    if (cycle.empty()) continue;
    for (const uint32_t node : cycle) reported[node] = true;
    report_cycle(nodes, wiring, cycle, report);
  }
  return std::find(left.begin(), left.end(), true) == left.end();
}

}  // namespace lightloom::linking
