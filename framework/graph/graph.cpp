#include "framework/graph/graph.hpp"

#include "framework/graph/schedule.hpp"

namespace lightloom {

std::string value_name(const Value& value) {
  return value.pass + "." + value.port + (value.part.empty() ? "" : "." + value.part);
}

uint64_t byte_size(const Value& value) {
  return byte_size(value.desc) * ring_layers(value);
}

void mark_reads(Graph& graph) {
  for (Value& value : graph.values) value.read = false;
  for (const GraphOutput& output : graph.outputs) graph.values[output.value].read = true;
  for (const ValueId value : graph.captures) graph.values[value].read = true;
  std::vector<bool> of_earlier_frames(graph.values.size());  // by value
  for (const uint32_t index : schedule(graph).order) {
    GraphPass& pass = graph.passes[index];
    pass.looks_back = false;
    for (const Use& input : pass.inputs) {
      graph.values[input.value].read = true;
      pass.looks_back = pass.looks_back || input.last_age > 0 || of_earlier_frames[input.value];
    }
    for (const Use& output : pass.outputs) of_earlier_frames[output.value] = pass.looks_back;
  }
}

}  // namespace lightloom
