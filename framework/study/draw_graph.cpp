#include "framework/study/draw_graph.hpp"

#include <algorithm>
#include <string>

namespace lightloom::study {
namespace {

void add_edge(const Graph& graph, const GraphPass& pass, const Use& use, uint32_t age,
              std::vector<StudyResults::DrawnEdge>& edges) {
  const Value& value = graph.values[use.value];
  if (value.constant) return;
  const auto same = std::find_if(edges.begin(), edges.end(), [&](const StudyResults::DrawnEdge& edge) {
    return edge.from == value.pass && edge.to == pass.name && edge.age == age;
  });
  if (same == edges.end()) {
    edges.push_back({value.pass, pass.name, value.port, age});
  } else if ((", " + same->label + ",").find(" " + value.port + ",") == std::string::npos) {
    same->label += ", " + value.port;
  }
}

}  // namespace

void draw_graph(const Plan& plan, StudyResults& results) {
  for (const std::vector<PlanStep>* steps : {&plan.once, &plan.steps})
    for (const PlanStep& step : *steps) {
      const GraphPass& pass = plan.graph.passes[step.pass];
      results.graph_passes.push_back({pass.name, pass.type->name, steps == &plan.once});
      for (const Use& use : pass.inputs) {
        add_edge(plan.graph, pass, use, use.first_age, results.graph_edges);
        if (use.last_age > use.first_age) add_edge(plan.graph, pass, use, use.last_age, results.graph_edges);
      }
    }
}

}  // namespace lightloom::study
