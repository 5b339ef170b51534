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

}  // namespace lightloom
