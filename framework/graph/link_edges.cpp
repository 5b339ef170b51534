#include <algorithm>
#include <utility>

#include "framework/base/text.hpp"
#include "framework/graph/link_state.hpp"

namespace lightloom::linking {
namespace {

std::optional<uint32_t> part_index(const Port& port, std::string_view name) {
  for (uint32_t i = 0; i < port.parts.size(); ++i)
    if (port.parts[i].name == name) return i;
  return std::nullopt;
}

std::vector<std::string> part_names(const Port& port) {
  std::vector<std::string> names;
  for (const PortPart& part : port.parts) names.push_back(part.name);
  return names;
}

bool dropped(const Node& node, const std::string& input) {
  return std::find(node.dropped_inputs.begin(), node.dropped_inputs.end(), input) != node.dropped_inputs.end();
}

const ConnectionSpec* find_connection(const Node& node, const std::string& input) {
  if (dropped(node, input)) return nullptr;
  for (const ConnectionSpec& connection : node.spec->inputs)
    if (connection.name == input) return &connection;
  return nullptr;
}

std::string kind_name(const Port& port) {
  return port.bundle.empty() ? "a single image" : "a '" + port.bundle + "' bundle";
}

std::string_view class_name(NumericClass numeric) {
  return numeric == NumericClass::floating ? "floating-point" : "unsigned integer";
}

/// A misspelt input is reported as such; that the right one is missing then goes without saying.
bool misspelt(const Node& node, const std::string& missing) {
  return std::any_of(node.spec->inputs.begin(), node.spec->inputs.end(), [&](const ConnectionSpec& connection) {
    return !dropped(node, connection.name) && node.type->find_port(connection.name, Direction::in) == nullptr &&
           closest_match(connection.name, {missing}).has_value();
  });
}

}  // namespace

Wiring EdgeResolver::resolve(const GraphSpec& spec) {
  Wiring wiring;
  wiring.inputs.resize(nodes_.list.size());
  for (uint32_t i = 0; i < nodes_.list.size(); ++i) {
    const Node& node = nodes_.list[i];
    if (node.type != nullptr && node.enabled())
      for (const Port& port : node.type->ports)
        if (port.direction == Direction::in) wiring.inputs[i].push_back(resolve_input(i, port));
    check_node(i, wiring.inputs[i]);
  }
  for (const ConnectionSpec& output : spec.outputs) wiring.outputs.push_back(resolve_output(output));
  return wiring;
}

void EdgeResolver::check_node(uint32_t index, const std::vector<ResolvedInput>& inputs) {
  const Node& node = nodes_.list[index];
  for (const ConnectionSpec& connection : node.spec->inputs) {
    const bool fell_away = (node.swapped_by && node.type == nullptr) || dropped(node, connection.name);
    if (!fell_away) static_cast<void>(find_target(connection.edge, node.enabled()));
  }
  for (const ResolvedInput& input : inputs) {
    if (input.state != Connection::absent || input.port->optional || misspelt(node, input.port->name)) continue;
    report_.error("missing-input", node.spec->where,
                  "pass '" + node.spec->name + "' of type '" + node.type->name + "' needs input '" + input.port->name +
                      "' (" + kind_name(*input.port) + ")",
                  "connect it under 'in': \"" + input.port->name + "\": \"pass.port\"");
  }
}

ResolvedInput EdgeResolver::resolve_input(uint32_t index, const Port& port) {
  ResolvedInput input;
  input.port = &port;
  const Node& node = nodes_.list[index];
  const ConnectionSpec* connection = find_connection(node, port.name);
  if (connection == nullptr) return input;
  input.edge = &connection->edge;
  input.state = Connection::broken;
  const std::optional<Target> target = find_target(connection->edge, true);
  if (!target || !check_kind({port.name, &node.spec->name}, port, connection->edge, *target)) return input;
  input.state = Connection::connected;
  for (const PortPart& part : port.parts) {
    const uint32_t source = target->part ? *target->part : *part_index(*target->port, part.name);
    const Found found = follow({target->node, target->port, source}, connection->edge);
    if (found.state != Connection::connected) {
      input.state = found.state;
      input.culprit = found.culprit;
      input.sources.clear();
      break;
    }
    input.sources.push_back(found.source);
  }
  if (port.needed_with && !port.needed_with(node.resolved)) {
    input.state = Connection::unneeded;
    input.ignored = std::exchange(input.sources, {});
  }
  return input;
}

std::optional<EdgeResolver::Target> EdgeResolver::find_target(const EdgeSpec& edge, bool consumer_enabled) {
  if (edge.pass.empty()) return std::nullopt;
  if (const auto found = nodes_.by_name.find(edge.pass); found != nodes_.by_name.end()) {
    const Node& node = nodes_.list[found->second];
    // What a swap took from a disabled pass does not matter.
    if (node.type == nullptr || (!consumer_enabled && node.swapped_by)) return std::nullopt;
    return find_port(edge, found->second);
  }
  report_.error("unknown-pass", edge.where,
                "edge " + in_quotes(edge.text) + ": there is no pass " + in_quotes(edge.pass),
                did_you_mean(edge.pass, nodes_.names(), "passes"));
  return std::nullopt;
}

std::optional<EdgeResolver::Target> EdgeResolver::find_port(const EdgeSpec& edge, uint32_t index) {
  const PassType& type = *nodes_.list[index].type;
  const auto which = [&] {
    return "edge " + in_quotes(edge.text) + ": pass '" + edge.pass + "' of type '" + type.name + "'";
  };
  const Port* port = type.find_port(edge.port, Direction::out);
  if (port == nullptr) {
    std::vector<std::string> names;
    for (const Port& candidate : type.ports)
      if (candidate.direction == Direction::out) names.push_back(candidate.name);
    const bool scratch = type.find_port(edge.port, Direction::scratch) != nullptr;
    report_.error("unknown-port", edge.where,
                  which() + " has no output " + in_quotes(edge.port) +
                      (scratch ? "; it is scratch, which lives within the pass alone" : ""),
                  did_you_mean(edge.port, names, "its outputs"));
    return std::nullopt;
  }
  Target target{index, port, std::nullopt};
  if (!edge.part.empty()) {
    target.part = part_index(*port, edge.part);
    if (!target.part) {
      report_.error(
          "unknown-part", edge.where, which() + ": output '" + port->name + "' has no part " + in_quotes(edge.part),
          port->bundle.empty() ? "it is a single image" : did_you_mean(edge.part, part_names(*port), "its parts"));
      return std::nullopt;
    }
  }
  return target;
}

std::string EdgeResolver::Consumer::text() const {
  return pass == nullptr ? "output '" + name + "'" : "input '" + name + "' of pass '" + *pass + "'";
}

bool EdgeResolver::check_kind(const Consumer& consumer, const Port& input, const EdgeSpec& edge, const Target& target) {
  if (edge.first_age != edge.last_age && !input.array) {
    report_.error("unexpected-range", edge.where,
                  consumer.text() + " takes one image, not the range " + in_quotes(edge.text),
                  "name one age, for instance \"" + edge.text.substr(0, edge.text.find("..")) + "\"");
    return false;
  }
  if (!check_bundle(consumer, input, edge, target)) return false;
  if (target.port->dimension != input.dimension) {
    const auto name = [](Dimension dimension) { return dimension == Dimension::d2 ? "2D" : "3D"; };
    report_.error("dimension-mismatch", edge.where,
                  consumer.text() + " is " + name(input.dimension) + ", but " + in_quotes(edge.text) + " is " +
                      name(target.port->dimension));
    return false;
  }
  for (const PortPart& part : input.parts) {
    const uint32_t source = target.part ? *target.part : *part_index(*target.port, part.name);
    const NumericClass given = format_info(target.port->parts[source].format).numeric;
    const NumericClass wanted = format_info(part.format).numeric;
    if (given == wanted) continue;
    report_.error("numeric-mismatch", edge.where,
                  consumer.text() + " reads " + std::string(class_name(wanted)) + " texels, but " +
                      in_quotes(edge.text) + " is " + std::string(format_info(target.port->parts[source].format).name));
    return false;
  }
  return true;
}

bool EdgeResolver::check_bundle(const Consumer& consumer, const Port& input, const EdgeSpec& edge,
                                const Target& target) {
  const bool whole = !target.part.has_value();
  if (input.bundle != (whole ? target.port->bundle : "")) {
    const bool name_a_part = input.bundle.empty() && whole;
    report_.error("bundle-mismatch", edge.where,
                  consumer.text() + " takes " + kind_name(input) + ", but " + in_quotes(edge.text) + " is " +
                      (whole ? kind_name(*target.port) : "a single image"),
                  name_a_part ? "name one part: " + join(part_names(*target.port), ", ") : "");
    return false;
  }
  if (!whole) return true;
  for (const PortPart& part : input.parts) {
    if (part_index(*target.port, part.name)) continue;
    report_.error(
        "bundle-mismatch", edge.where,
        consumer.text() + " needs part '" + part.name + "', which " + in_quotes(edge.text) + " does not have");
    return false;
  }
  return true;
}

EdgeResolver::Found EdgeResolver::follow(const ImageRef& image, const EdgeSpec& edge) {
  const Ending ending = ending_of(image);
  if (ending.endless) {
    report_.error("cycle", edge.where,
                  "edge " + in_quotes(edge.text) + " leads through disabled passes back to '" +
                      image_name(nodes_, ending.image) + "' and never to a pass that runs");
    return {};
  }
  if (ending.state != Connection::connected) return {ending.state, {}, ending.image};
  const uint32_t oldest = edge.last_age + ending.age;
  if (oldest > kMaximumAge) {
    report_.error("out-of-range", edge.where,
                  "edge " + in_quotes(edge.text) + " reaches " + std::to_string(oldest) +
                      " frames back through disabled passes; the limit is " + std::to_string(kMaximumAge));
    return {};
  }
  return {Connection::connected, {ending.image, ending.constant, edge.first_age + ending.age, oldest}, {}};
}

EdgeResolver::Ending EdgeResolver::ending_of(const ImageRef& start) {
  struct Step {
    ImageRef image;
    uint32_t age = 0;  ///< of the edge to the next
  };
  std::vector<Step> way;
  Ending ending{Connection::connected, start};
  while (!nodes_.list[ending.image.node].enabled()) {
    const ImageRef image = ending.image;
    // Who comes back to an image that is still under way goes round for ever.
    const auto [known, is_new] = endings_.try_emplace(image, Ending{.image = image, .endless = true});
    if (!is_new) {
      ending = known->second;
      break;
    }
    const Found next = image.port->bypass && !image.port->bypass->input.empty() ? through_bypass(image) : Found{};
    way.push_back({image, next.source.first_age});
    if (next.state == Connection::connected) {
      ending.image = next.source.image;
      continue;
    }
    const bool constant = image.port->bypass && image.port->bypass->input.empty();
    if (constant)
      ending.constant = true;
    else if (!image.port->bypass)
      ending = {Connection::no_bypass, image};
    else
      ending = {next.state, next.culprit};
    break;
  }
  std::reverse(way.begin(), way.end());
  for (const auto& step : way) {
    ending.age += step.age;
    endings_[step.image] = ending;
  }
  return ending;
}

EdgeResolver::Found EdgeResolver::through_bypass(const ImageRef& image) {
  const Node& node = nodes_.list[image.node];
  const Port& input = *node.type->find_port(image.port->bypass->input, Direction::in);
  const ConnectionSpec* connection = find_connection(node, input.name);
  if (connection == nullptr) return {Connection::no_bypass, {}, image};
  const EdgeSpec& edge = connection->edge;
  const std::optional<Target> target = find_target(edge, true);
  if (!target || !check_kind({input.name, &node.spec->name}, input, edge, *target)) return {};
  const uint32_t part = target->part ? *target->part : *part_index(*target->port, image.port->parts[image.part].name);
  return {Connection::connected, {{target->node, target->port, part}, false, edge.first_age, edge.last_age}, {}};
}

ResolvedOutput EdgeResolver::resolve_output(const ConnectionSpec& output) {
  ResolvedOutput resolved;
  resolved.spec = &output;
  const std::optional<Target> target = find_target(output.edge, true);
  if (!target) return resolved;
  // An output is like an input that takes any one image.
  Port port;
  port.parts = {target->port->parts[target->part.value_or(0)]};
  port.parts.front().name.clear();
  port.dimension = target->port->dimension;
  if (target->port->bundle.empty() || target->part) {
    if (!check_kind({output.name}, port, output.edge, *target)) return resolved;
  } else {
    static_cast<void>(check_bundle({output.name}, port, output.edge, *target));
    return resolved;
  }
  const Found found = follow({target->node, target->port, target->part.value_or(0)}, output.edge);
  resolved.state = found.state;
  resolved.source = found.source;
  resolved.culprit = found.culprit;
  return resolved;
}

}  // namespace lightloom::linking
