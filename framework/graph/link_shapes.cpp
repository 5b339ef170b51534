#include <algorithm>

#include "framework/base/text.hpp"
#include "framework/graph/link_state.hpp"

namespace lightloom::linking {
namespace {

/// What an option asks for instead of the graph's own size.
Extent3 wanted_size(const SizeSpec& own, const std::optional<std::pair<uint32_t, uint32_t>>& wanted, const char* option,
                    Report& report) {
  if (!wanted) return {own.width, own.height, 1};
  const auto [width, height] = *wanted;
  const auto valid = [](uint32_t length) { return length >= 1 && length <= kMaximumImageSize; };
  if (valid(width) && valid(height)) return {width, height, 1};
  report.error("out-of-range", {option, 0, 0},
               "an image must be 1 to " + std::to_string(kMaximumImageSize) + " pixels wide and high, not " +
                   std::to_string(width) + "x" + std::to_string(height));
  return {own.width, own.height, 1};
}

}  // namespace

ShapeResolver::ShapeResolver(const Nodes& nodes, EdgeResolver& edges, const Input& input, Report& report)
    : nodes_(nodes),
      edges_(edges),
      input_(input),
      report_(report),
      view_(wanted_size(input.spec.view, input.options.view, "--size", report)),
      trace_(wanted_size(input.spec.trace, input.options.trace, "--trace-size", report)) {}

std::optional<Extent3> ShapeResolver::extent_of(const ImageRef& image) {
  const auto same = [&](const Known& known) { return known.port == image.port && known.node == image.node; };
  if (const auto found = std::find_if(known_.begin(), known_.end(), same); found != known_.end()) {
    if (found->in_progress)
      report_.error(
          "unknown-shape", nodes_.list[image.node].spec->where,
          "the size of '" + nodes_.list[image.node].spec->name + "." + image.port->name + "' depends on itself",
          "give a pass of this loop an input of known size");
    return found->extent;
  }
  const std::size_t index = known_.size();
  known_.push_back({image.port, image.node, true, {}});
  const std::optional<Extent3> extent = by_rule(image.node, *image.port);
  known_[index].in_progress = false;
  known_[index].extent = extent;
  return extent;
}

Extent3 ShapeResolver::grid(const Node& node) const {
  const int64_t resolution = node.resolved.integer("resolution");
  if (input_.environment.grid_extent) return input_.environment.grid_extent(resolution);
  const auto edge = static_cast<uint32_t>(resolution);
  return {edge, edge, edge};
}

std::optional<Extent3> ShapeResolver::by_rule(uint32_t index, const Port& port) {
  const Node& node = nodes_.list[index];
  switch (port.extent) {
    case ExtentRule::view:
      return view_;
    case ExtentRule::trace:
      return trace_;
    case ExtentRule::grid:
      return grid(node);
    case ExtentRule::any:
      return std::nullopt;
    case ExtentRule::fixed:
      return port.fixed_extent;
    case ExtentRule::like:
      break;
  }
  const Port& like = *node.type->find_port(port.like, Direction::in);
  const ResolvedInput model = edges_.resolve_input(index, like);
  if (model.state == Connection::connected) return extent_of(model.sources.front().image);
  if (like.optional && model.state != Connection::broken) return view_;
  // An enabled pass's missing or broken input has been reported as such.
  if (!node.enabled() && model.state != Connection::broken)
    report_.error("unknown-shape", node.spec->where,
                  "disabled pass '" + node.spec->name + "' cannot be replaced by a constant: the size of '" +
                      port.name + "' is that of its input '" + port.like + "', which has no source",
                  "connect '" + port.like + "'");
  return std::nullopt;
}

void ShapeResolver::check_inputs(uint32_t index, const std::vector<ResolvedInput>& inputs) {
  const Node& node = nodes_.list[index];
  for (const ResolvedInput& input : inputs) {
    if (input.state != Connection::connected || input.port->extent == ExtentRule::any) continue;
    const std::optional<Extent3> given = extent_of(input.sources.front().image);
    const std::optional<Extent3> wanted = by_rule(index, *input.port);
    if (!given || !wanted || *given == *wanted) continue;
    std::string model;
    if (input.port->extent == ExtentRule::like) {
      const auto other = std::find_if(inputs.begin(), inputs.end(), [&](const ResolvedInput& candidate) {
        return candidate.port->name == input.port->like;
      });
      model = "that of input '" + input.port->like + "', which is " + image_name(nodes_, other->sources.front().image);
    } else {
      model = input.port->extent == ExtentRule::view    ? "the view's"
              : input.port->extent == ExtentRule::trace ? "the trace's"
              : input.port->extent == ExtentRule::fixed ? "fixed"
                                                        : "the grid's";
    }
    report_.error("shape-mismatch", input.edge->where,
                  "input '" + input.port->name + "' of pass '" + node.spec->name + "' must have the size " +
                      to_string(*wanted) + " (" + model + "), but " + image_name(nodes_, input.sources.front().image) +
                      " has " + to_string(*given));
  }
}

}  // namespace lightloom::linking
