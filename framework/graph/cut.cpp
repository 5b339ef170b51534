#include "framework/graph/cut.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

namespace lightloom {
namespace {

class Cutter {
 public:
  Cutter(const Graph& whole, const std::vector<bool>& chosen)
      : whole_(whole), chosen_(chosen), makers_(makers(whole)), ids_(whole.values.size()) {}

  Cut run() {
    result_.graph = whole_;
    keep_values();
    keep_passes();
    keep_outputs();
    keep_captures();
    for (const auto& [value, age] : needed_) result_.needed.push_back({value, age});
    return std::move(result_);
  }

 private:
  /// Which pass makes a value; none makes a constant.
  static std::vector<std::optional<size_t>> makers(const Graph& graph) {
    std::vector<std::optional<size_t>> result(graph.values.size());
    for (size_t pass = 0; pass < graph.passes.size(); ++pass)
      for (const auto* uses : {&graph.passes[pass].outputs, &graph.passes[pass].scratch})
        for (const Use& use : *uses) result[use.value] = pass;
    return result;
  }

  [[nodiscard]] bool is_made(ValueId value) const { return makers_[value] && chosen_[*makers_[value]]; }
  [[nodiscard]] bool is_constant(ValueId value) const { return !makers_[value]; }

  void keep_values() {
    std::vector<bool> read(whole_.values.size(), false);
    for (size_t pass = 0; pass < whole_.passes.size(); ++pass)
      if (chosen_[pass])
        for (const Use& use : whole_.passes[pass].inputs) read[use.value] = true;
    result_.graph.values.clear();
    for (ValueId id = 0; id < whole_.values.size(); ++id) {
      if (!read[id] && !is_made(id) && !is_constant(id)) continue;
      ids_[id] = static_cast<ValueId>(result_.graph.values.size());
      Value value = whole_.values[id];
      if (!is_made(id) && !is_constant(id)) {
        value.constant = ClearColor{0, 0, 0, 0};
        value.persistent = false;
      }
      result_.graph.values.push_back(std::move(value));
    }
  }

  void keep_passes() {
    result_.graph.passes.clear();
    for (size_t index = 0; index < whole_.passes.size(); ++index) {
      if (!chosen_[index]) continue;
      GraphPass pass = whole_.passes[index];
      for (Use& use : pass.inputs) {
        for (uint32_t age = use.first_age; age <= use.last_age; ++age) need(use.value, age);
        use.value = *ids_[use.value];
      }
      for (auto* uses : {&pass.outputs, &pass.scratch})
        for (Use& use : *uses) use.value = *ids_[use.value];
      result_.graph.passes.push_back(std::move(pass));
    }
  }

  void need(ValueId value, uint32_t age) {
    if (!is_constant(value) && (age > 0 || !is_made(value))) needed_.emplace(*ids_[value], age);
  }

  void keep_outputs() {
    result_.graph.outputs.clear();
    for (const GraphOutput& output : whole_.outputs) {
      if (!is_made(output.value) && !is_constant(output.value)) continue;
      need(output.value, output.age);
      result_.graph.outputs.push_back({output.name, *ids_[output.value], output.age});
    }
  }

  void keep_captures() {
    result_.graph.captures.clear();
    for (const ValueId capture : whole_.captures)
      if (is_made(capture)) result_.graph.captures.push_back(*ids_[capture]);
    mark_reads(result_.graph);
    std::vector<ValueId> lost;
    for (ValueId id = 0; id < whole_.values.size(); ++id)
      if (is_made(id) && whole_.values[id].read && !result_.graph.values[*ids_[id]].read) lost.push_back(*ids_[id]);
    std::vector<ValueId> all;
    std::merge(result_.graph.captures.begin(), result_.graph.captures.end(), lost.begin(), lost.end(),
               std::back_inserter(all));
    result_.graph.captures = std::move(all);
    mark_reads(result_.graph);
  }

  const Graph& whole_;
  const std::vector<bool>& chosen_;
  std::vector<std::optional<size_t>> makers_;
  std::vector<std::optional<ValueId>> ids_;  ///< in the cut, by value of the whole
  std::set<std::pair<ValueId, uint32_t>> needed_;
  Cut result_;
};

}  // namespace

Cut cut(const Graph& graph, const std::vector<bool>& chosen) {
  return Cutter(graph, chosen).run();
}

Graph for_one_frame(Graph graph) {
  for (GraphPass& pass : graph.passes) pass.once.clear();
  for (Value& value : graph.values) value.persistent = false;
  return graph;
}

}  // namespace lightloom
