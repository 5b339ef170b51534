#include "framework/graph/hoist.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "framework/base/text.hpp"
#include "framework/graph/schedule.hpp"

namespace lightloom {
namespace {

constexpr std::array<std::pair<FrameState, const char*>, 7> kStateNames{{
    {FrameState::camera, "the camera"},
    {FrameState::time, "the time"},
    {FrameState::seed, "the seed"},
    {FrameState::static_geometry, "static geometry"},
    {FrameState::dynamic_geometry, "dynamic geometry (there is none)"},
    {FrameState::materials, "materials"},
    {FrameState::lights, "lights"},
}};

class Hoister {
 public:
  Hoister(Graph& graph, FrameState changing) : graph_(graph), changing_(changing), fixed_(graph.values.size()) {
    for (std::size_t id = 0; id < graph.values.size(); ++id) fixed_[id] = graph.values[id].constant.has_value();
  }

  void run() {
    // Only this frame's values can be fixed, so that producers before readers is all the order that is needed.
    for (const uint32_t index : schedule(graph_).order) {
      GraphPass& pass = graph_.passes[index];
      if (!runs_once(pass)) continue;
      pass.once = reason(pass);
      mark(pass.outputs);
      mark(pass.scratch);
    }
  }

 private:
  bool runs_once(const GraphPass& pass) const {
    if (pass.type->side_effect || (pass.type->reads_of(pass.params) & changing_) != FrameState::none) return false;
    return std::all_of(pass.inputs.begin(), pass.inputs.end(), [&](const Use& use) { return fixed_[use.value]; }) &&
           std::none_of(pass.outputs.begin(), pass.outputs.end(),
                        [&](const Use& use) { return graph_.values[use.value].history > 0; });
  }

  void mark(const std::vector<Use>& written) {
    for (const Use& use : written) {
      fixed_[use.value] = true;
      graph_.values[use.value].persistent = false;
    }
  }

  std::string reason(const GraphPass& pass) const {
    std::vector<std::string> sources;
    const FrameState reads = pass.type->reads_of(pass.params);
    for (const auto& [state, name] : kStateNames)
      if (contains(reads, state)) sources.emplace_back(name);
    for (const Use& use : pass.inputs) {
      const Value& value = graph_.values[use.value];
      const std::string name = value.pass + "." + value.port;
      if (std::find(sources.begin(), sources.end(), name) == sources.end()) sources.push_back(name);
    }
    return sources.empty() ? "it reads nothing" : "what it reads never changes: " + join(sources, ", ");
  }

  Graph& graph_;
  FrameState changing_;
  std::vector<bool> fixed_;  ///< by value: the same in every frame
};

}  // namespace

void hoist(Graph& graph, FrameState changing) {
  Hoister(graph, changing).run();
}

}  // namespace lightloom
