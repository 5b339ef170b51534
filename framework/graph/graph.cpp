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
  std::vector<const GraphPass*> found = {&pass};  // each pass once, however many ways lead to it
  for (std::size_t next = 0; next < found.size(); ++next) {
    for (const Use& input : found[next]->inputs) {
      if (input.last_age > 0) return true;
      const auto writes = [&](const Use& output) { return output.value == input.value; };
      const auto producer = std::find_if(graph.passes.begin(), graph.passes.end(), [&](const GraphPass& candidate) {
        return std::any_of(candidate.outputs.begin(), candidate.outputs.end(), writes);
      });
      if (producer == graph.passes.end() || std::find(found.begin(), found.end(), &*producer) != found.end()) continue;
      found.push_back(&*producer);
    }
  }
  return false;
}

}  // namespace lightloom
