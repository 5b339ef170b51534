#include <algorithm>
#include <deque>

#include "framework/graph/link_state.hpp"

namespace lightloom::linking {
namespace {

/// Which node reads this frame's values of which: for each node those behind it and those before it, one entry a use.
struct Flow {
  std::vector<std::vector<uint32_t>> consumers;
  std::vector<std::vector<uint32_t>> sources;
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
  flow.sources.resize(wiring.inputs.size());
  for (uint32_t i = 0; i < wiring.inputs.size(); ++i) {
    for_each_source(wiring.inputs[i], [&](uint32_t source, const ResolvedInput& /*input*/) {
      flow.consumers[source].push_back(i);
      flow.sources[i].push_back(source);
    });
  }
  return flow;
}

/// Takes away, one after another, all nodes that have nothing left in `before`.
void take_ends_away(const std::vector<std::vector<uint32_t>>& before, const std::vector<std::vector<uint32_t>>& behind,
                    std::vector<bool>& left) {
  std::vector<std::size_t> waits_for(left.size());
  std::vector<uint32_t> ends;
  for (uint32_t i = 0; i < left.size(); ++i) {
    for (const uint32_t node : before[i]) waits_for[i] += left[node] ? 1 : 0;
    if (left[i] && waits_for[i] == 0) ends.push_back(i);
  }
  while (!ends.empty()) {
    const uint32_t end = ends.back();
    ends.pop_back();
    left[end] = false;
    for (const uint32_t node : behind[end])
      if (left[node] && --waits_for[node] == 0) ends.push_back(node);
  }
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
  std::vector<bool> left(nodes.list.size(), true);
  take_ends_away(flow.sources, flow.consumers, left);
  if (std::find(left.begin(), left.end(), true) == left.end()) return true;
  take_ends_away(flow.consumers, flow.sources, left);  // what only follows from a cycle has none to show
  std::vector<bool> reported(left.size(), false);
  for (uint32_t i = 0; i < left.size(); ++i) {
    if (!left[i] || reported[i]) continue;
    const std::vector<uint32_t> cycle = shortest_cycle(flow, i);
    if (cycle.empty()) continue;
    for (const uint32_t node : cycle) reported[node] = true;
    report_cycle(nodes, wiring, cycle, report);
  }
  return false;
}

}  // namespace lightloom::linking
