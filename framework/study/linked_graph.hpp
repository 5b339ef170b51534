#pragma once

#include <optional>
#include <string>

#include "framework/base/diagnostics.hpp"
#include "framework/graph/graph_spec.hpp"
#include "framework/graph/pass_type.hpp"
#include "framework/graph/plan.hpp"
#include "framework/scene/scene.hpp"
#include "framework/study/study_spec.hpp"

namespace lightloom::study {

/// A graph with changes, or why it cannot be.
struct Linked {
  std::optional<Plan> plan;
  Diagnostics diagnostics;

  [[nodiscard]] std::string first_error() const;
  /// Are all errors such that the changes can be understood, but the graph that they leave does not work?
  [[nodiscard]] bool is_graphs_fault() const;
};

[[nodiscard]] Linked link_changes(const GraphSpec& graph, const PassRegistry& registry, const Changes& changes,
                                  const scene::Scene& scene);

}  // namespace lightloom::study
