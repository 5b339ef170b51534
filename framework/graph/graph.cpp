#include "framework/graph/graph.hpp"

#include <algorithm>

namespace lightloom {

std::string value_name(const Value& value) {
  return value.pass + "." + value.port + (value.part.empty() ? "" : "." + value.part);
}

uint64_t byte_size(const Value& value) {
  return byte_size(value.desc) * ring_layers(value);
}

bool is_read(const Graph& graph, ValueId value) {
  const auto reads = [value](const auto& use) { return use.value == value; };
  return std::any_of(graph.outputs.begin(), graph.outputs.end(), reads) ||
         std::find(graph.captures.begin(), graph.captures.end(), value) != graph.captures.end() ||
         std::any_of(graph.passes.begin(), graph.passes.end(),
                     [&](const GraphPass& pass) { return std::any_of(pass.inputs.begin(), pass.inputs.end(), reads); });
}

bool looks_back(const Graph& graph, const GraphPass& pass) {
  const auto writes = [](const GraphPass& candidate, ValueId value) {
    return std::any_of(candidate.outputs.begin(), candidate.outputs.end(),
                       [&](const Use& use) { return use.value == value; });
  };
  return std::any_of(pass.inputs.begin(), pass.inputs.end(), [&](const Use& use) {
    if (use.last_age > 0) return true;
    // Edges within a frame have no cycles.
    return std::any_of(graph.passes.begin(), graph.passes.end(), [&](const GraphPass& producer) {
      return writes(producer, use.value) && looks_back(graph, producer);
    });
  });
}

}  // namespace lightloom
