#include <algorithm>

#include "framework/graph/link_state.hpp"

namespace lightloom::linking {
namespace {

std::string shader_name(const Port& port, const PortPart& part) {
  const std::string prefix = port.direction == Direction::out ? "out_" : "";
  return prefix + port.name + (part.name.empty() ? "" : "_" + part.name);
}

class Assembler {
 public:
  Assembler(const Nodes& nodes, const Wiring& wiring, const Needs& needs, ShapeResolver& shapes)
      : nodes_(nodes), wiring_(wiring), needs_(needs), shapes_(shapes) {}

  std::optional<Graph> run() {
    graph_.view = shapes_.view();
    graph_.trace = shapes_.trace();
    for (const ScalarSpec& param : nodes_.graph_params) graph_.params.emplace_back(param.name, param.value);
    // Values first: a history edge may point at a pass that is declared later.
    for (uint32_t i = 0; i < nodes_.list.size(); ++i) add_values(i);
    for (uint32_t i = 0; i < nodes_.list.size(); ++i)
      if (needs_.live[i]) add_pass(i);
    for (const ResolvedOutput& output : wiring_.outputs)
      if (output.state == Connection::connected)
        graph_.outputs.push_back({output.spec->name, value_of(output.source), output.source.first_age});
    for (const ImageRef& image : needs_.captures) graph_.captures.push_back(ids_.at(image));
    std::sort(graph_.captures.begin(), graph_.captures.end());
    mark_persistent();
    mark_reads(graph_);
    add_remarks();
    if (!complete_) return std::nullopt;
    return std::move(graph_);
  }

 private:
  ValueId add_value(const ImageRef& image, const std::optional<ClearColor>& constant) {
    const PortPart& part = image.port->parts[image.part];
    const std::optional<Extent3> extent = shapes_.extent_of(image);
    complete_ = complete_ && extent.has_value();
    graph_.values.push_back(
        {nodes_.list[image.node].spec->name, image.port->name, part.name,
         ImageDesc{nodes_.list[image.node].format_of(part), image.port->dimension, extent.value_or(Extent3{})},
         constant, 0, image.port->direction == Direction::scratch, false});
    const auto id = static_cast<ValueId>(images_.size());
    images_.push_back(image);
    ids_.emplace(image, id);
    return id;
  }

  void add_values(uint32_t node) {
    if (!needs_.live[node]) return;
    for (const Port& port : nodes_.list[node].type->ports)
      for (uint32_t part = 0; part < port.parts.size(); ++part)
        if (port.direction != Direction::in) add_value({node, &port, part}, std::nullopt);
  }

  /// The value's id; its ring grows to the oldest age that is read. A constant is the same at every age.
  ValueId value_of(const Source& source) {
    const auto known = ids_.find(source.image);
    const ValueId id =
        known != ids_.end() ? known->second : add_value(source.image, source.image.port->bypass->constant);
    Value& value = graph_.values[id];
    if (!source.constant) value.history = std::max(value.history, source.last_age);
    return id;
  }

  void add_pass(uint32_t index) {
    const Node& node = nodes_.list[index];
    GraphPass pass;
    pass.name = node.spec->name;
    pass.type = node.type;
    pass.params = node.resolved;
    if (node.type == node.spec->own_type.get()) graph_.own_types.push_back(node.spec->own_type);
    for (const ResolvedInput& input : wiring_.inputs[index]) {
      if (input.state != Connection::connected) pass.unconnected.push_back(input.port->name);
      for (std::size_t part = 0; part < input.sources.size(); ++part) {
        const Source& source = input.sources[part];
        pass.inputs.push_back({input.port->name, input.port->parts[part].name,
                               shader_name(*input.port, input.port->parts[part]), input.port->access, value_of(source),
                               source.first_age, source.last_age, input.port->array});
      }
    }
    for (const Port& port : node.type->ports) {
      if (port.direction == Direction::in) continue;
      for (uint32_t part = 0; part < port.parts.size(); ++part)
        (port.direction == Direction::out ? pass.outputs : pass.scratch)
            .push_back({port.name, port.parts[part].name, shader_name(port, port.parts[part]), port.access,
                        ids_.at({index, &port, part}), 0, 0, false});
    }
    graph_.passes.push_back(std::move(pass));
  }

  /// A ring's next layer holds what is older than the frame before, so nothing of the port is kept if any part has one.
  void mark_persistent() {
    ByImage<bool> has_ring;  // by the first part of a port
    for (std::size_t id = 0; id < images_.size(); ++id)
      if (graph_.values[id].history > 0) has_ring[{images_[id].node, images_[id].port, 0}] = true;
    for (std::size_t id = 0; id < images_.size(); ++id)
      graph_.values[id].persistent = images_[id].port->persistent && !graph_.values[id].constant &&
                                     !has_ring.contains({images_[id].node, images_[id].port, 0});
  }

  void add_remarks() {
    for (uint32_t i = 0; i < nodes_.list.size(); ++i) {
      const Node& node = nodes_.list[i];
      if (!node.enabled()) {
        graph_.bypassed.push_back({node.spec->name, node.disabled});
      } else if (!needs_.live[i]) {
        graph_.culled.push_back({node.spec->name, needs_.culled[i]});
      }
    }
  }

  const Nodes& nodes_;
  const Wiring& wiring_;
  const Needs& needs_;
  ShapeResolver& shapes_;
  Graph graph_;
  std::vector<ImageRef> images_;  ///< by value id
  ByImage<ValueId> ids_;
  bool complete_ = true;
};

}  // namespace

std::optional<Graph> assemble(const Nodes& nodes, const Wiring& wiring, const Needs& needs, ShapeResolver& shapes) {
  return Assembler(nodes, wiring, needs, shapes).run();
}

}  // namespace lightloom::linking
