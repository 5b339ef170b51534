#include "framework/graph/link.hpp"

#include <algorithm>

#include "framework/graph/hoist.hpp"
#include "framework/graph/link_state.hpp"

namespace lightloom {
namespace linking {

bool Report::is_new(std::string_view code, const SourceLocation& where, const std::string& message) {
  return said_.emplace(where, code, message).second;
}

void Report::error(std::string_view code, const SourceLocation& where, const std::string& message,
                   const std::string& hint) {
  if (is_new(code, where, message)) diagnostics_.error(code, where, message, hint);
}

void Report::warning(std::string_view code, const SourceLocation& where, const std::string& message,
                     const std::string& hint) {
  if (is_new(code, where, message)) diagnostics_.warning(code, where, message, hint);
}

std::vector<std::string> Nodes::names() const {
  std::vector<std::string> result;
  for (const Node& node : list) result.push_back(node.spec->name);
  return result;
}

std::string image_name(const Nodes& nodes, const ImageRef& image) {
  const std::string& part = image.port->parts[image.part].name;
  return nodes.list[image.node].spec->name + "." + image.port->name + (part.empty() ? "" : "." + part);
}

}  // namespace linking

std::optional<Graph> link(const GraphSpec& spec, const PassRegistry& registry, const LinkOptions& options,
                          const LinkEnvironment& environment, Diagnostics& diagnostics) {
  LinkEnvironment assumed = environment;
  if (options.general)
    for (auto& [name, present] : assumed.scene_features) present = true;
  const linking::Input input{spec, registry, options, assumed};
  linking::Report report(diagnostics);
  std::vector<std::string> notes;
  linking::Nodes nodes = linking::make_nodes(input, report, notes);
  linking::resolve_params(nodes, report);
  linking::resolve_formats(nodes, report, notes);
  linking::warn_unused_params(nodes, input, report);
  linking::EdgeResolver edges(nodes, report);
  const linking::Wiring wiring = edges.resolve(spec);
  const linking::Needs needs = linking::find_needs(nodes, wiring, options, report, notes);
  linking::check_bypasses(nodes, wiring, needs, report);
  linking::ShapeResolver shapes(nodes, wiring, edges, input, report);
  // Sizes follow the edges, so they mean something only where these lead somewhere.
  if (!linking::check_cycles(nodes, wiring, report)) return std::nullopt;
  for (uint32_t i = 0; i < nodes.list.size(); ++i)
    if (needs.live[i]) shapes.check_inputs(i, wiring.inputs[i]);
  std::optional<Graph> graph = linking::assemble(nodes, wiring, needs, shapes);
  if (!graph || diagnostics.has_errors()) return std::nullopt;
  graph->name = spec.name;
  graph->general = options.general;
  if (options.hoist && !options.general) hoist(*graph, environment.changing);
  graph->notes = std::move(notes);
  return graph;
}

}  // namespace lightloom
