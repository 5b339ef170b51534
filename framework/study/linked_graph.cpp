#include "framework/study/linked_graph.hpp"

#include "framework/run/compile_graph.hpp"

namespace lightloom::study {

std::string Linked::first_error() const {
  for (const Diagnostic& problem : diagnostics.sorted())
    if (problem.severity == Severity::error) return problem.message;
  return {};
}

bool Linked::is_graphs_fault() const {
  for (const Diagnostic& problem : diagnostics.all())
    if (problem.severity == Severity::error && problem.code != "no-bypass" && problem.where.line == 0) return false;
  return true;
}

Linked link_changes(const GraphSpec& graph, const PassRegistry& registry, const Changes& changes,
                    const scene::Scene& scene) {
  Linked linked;
  const std::optional<Graph> result =
      link(graph, registry, link_options(changes), run::link_environment(&scene), linked.diagnostics);
  if (result) linked.plan = compile(*result);
  return linked;
}

}  // namespace lightloom::study
