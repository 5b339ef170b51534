#include <algorithm>
#include <string_view>

#include "framework/graph/link_state.hpp"

namespace lightloom::linking {
namespace {

/// Can the param take the value? `value` is that of the graph's param where the pass refers to one.
bool takes(const Param& param, const ParamValue& value) {
  switch (param.type) {
    case ParamType::boolean:
      return std::holds_alternative<bool>(value);
    case ParamType::integer:
      return std::holds_alternative<int64_t>(value);
    case ParamType::real:
      return std::holds_alternative<int64_t>(value) || std::holds_alternative<double>(value);
    case ParamType::choice:
      break;
  }
  const std::string* text = std::get_if<std::string>(&value);
  return text != nullptr && std::find(param.choices.begin(), param.choices.end(), *text) != param.choices.end();
}

/// An unknown graph param is reported elsewhere, so it must not vanish here.
bool takes(const Param* param, const ScalarSpec& given, const std::vector<ScalarSpec>& graph_params) {
  if (param == nullptr) return false;
  const std::string* text = std::get_if<std::string>(&given.value);
  if (text == nullptr || !text->starts_with('$')) return takes(*param, given.value);
  const auto source = std::find_if(graph_params.begin(), graph_params.end(), [&](const ScalarSpec& candidate) {
    return candidate.name == std::string_view(*text).substr(1);
  });
  return source == graph_params.end() || source->broken || takes(*param, source->value);
}

/// Whatever fits into `old`, does it fit into `port`?
bool takes(const Port* port, const Port& old) {
  if (port == nullptr || port->bundle != old.bundle || port->dimension != old.dimension) return false;
  if (old.array && !port->array) return false;
  return std::all_of(port->parts.begin(), port->parts.end(), [&](const PortPart& part) {
    return std::any_of(old.parts.begin(), old.parts.end(), [&](const PortPart& given) {
      return given.name == part.name && format_info(given.format).numeric == format_info(part.format).numeric;
    });
  });
}

}  // namespace

void drop_misfits(Node& node, const Nodes& nodes, const PassRegistry& registry, std::vector<std::string>& notes) {
  if (!node.swapped_by || node.type == nullptr) return;
  const std::string which = *node.swapped_by + " makes '" + node.spec->name + "' a '" + node.type->name + "', without ";
  std::erase_if(node.params, [&](const ScalarSpec& given) {
    const std::vector<std::string>& before = node.swapped_params;
    if (given.broken || std::find(before.begin(), before.end(), given.name) == before.end()) return false;
    const Param* param = node.type->find_param(given.name);
    if (takes(param, given, nodes.graph_params)) return false;
    notes.push_back(which + "param '" + given.name + "'" +
                    (param == nullptr ? "" : ", which is of another kind there"));
    return true;
  });
  const PassType* old_type = type_in_file(*node.spec, registry);
  for (const ConnectionSpec& connection : node.spec->inputs) {
    const Port* port = node.type->find_port(connection.name, Direction::in);
    const Port* old = old_type == nullptr ? nullptr : old_type->find_port(connection.name, Direction::in);
    if (old == nullptr ? port != nullptr : takes(port, *old)) continue;
    node.dropped_inputs.push_back(connection.name);
    notes.push_back(which + "input '" + connection.name + "'" +
                    (port == nullptr ? "" : ", which is of another kind there"));
  }
}

}  // namespace lightloom::linking
