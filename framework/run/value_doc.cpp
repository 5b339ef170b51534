#include "framework/run/value_doc.hpp"

#include <algorithm>

namespace lightloom::run {

std::string value_doc(const Graph& graph, const Value& value) {
  const auto pass = std::find_if(graph.passes.begin(), graph.passes.end(),
                                 [&](const GraphPass& candidate) { return candidate.name == value.pass; });
  if (pass == graph.passes.end() || pass->type == nullptr) return {};
  const Port* port = pass->type->find_port(value.port, value.scratch ? Direction::scratch : Direction::out);
  if (port == nullptr) return {};
  for (const PortPart& part : port->parts)
    if (part.name == value.part && !part.doc.empty()) return part.doc;
  return port->doc;
}

}  // namespace lightloom::run
