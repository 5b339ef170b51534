#pragma once

#include <map>
#include <string>

#include "framework/graph/graph_spec.hpp"
#include "framework/study/plan_study.hpp"

namespace lightloom::study {

/// Finds the references that the rows of a study need, each once, and gives every row the index of its own.
class ReferencePlanner {
 public:
  ReferencePlanner(StudyPlan& plan, const GraphSpec& graph, const PassRegistry& registry, const gpu::DeviceInfo& device,
                   Diagnostics& diagnostics)
      : plan_(plan), graph_(graph), registry_(registry), device_(device), diagnostics_(diagnostics) {}

  /// Problems go to the diagnostics. Throws Error for files that cannot be read.
  void run();

 private:
  PlannedReference image(const PlannedRow& row) const;
  std::optional<PlannedReference> rendered(const PlannedRow& row, const GraphSpec& graph, const std::string& what);
  /// What the reference does to its graph, for this row.
  Changes changes_for(const PlannedRow& row) const;
  /// A param of the reference's graph that says what light is, as all rows have it; nothing where they differ.
  std::optional<std::string> shared_by_rows(const std::string& param) const;
  std::string key_of(const PlannedReference& reference) const;
  void add(PlannedRow& row, PlannedReference reference);

  StudyPlan& plan_;
  const GraphSpec& graph_;
  const PassRegistry& registry_;
  const gpu::DeviceInfo& device_;
  Diagnostics& diagnostics_;
  std::map<std::string, size_t> found_;
  std::vector<std::string> model_params_;  ///< of the reference's graph
};

}  // namespace lightloom::study
