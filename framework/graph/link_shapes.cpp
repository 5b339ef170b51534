#include <algorithm>

#include "framework/base/text.hpp"
#include "framework/graph/link_state.hpp"

namespace lightloom::linking {
namespace {

bool can_be(const std::pair<uint32_t, uint32_t>& size) {
  const auto valid = [](uint32_t length) { return length >= 1 && length <= kMaximumImageSize; };
  return valid(size.first) && valid(size.second);
}

void check_size(const std::optional<std::pair<uint32_t, uint32_t>>& wanted, const char* option, Report& report) {
  if (!wanted || can_be(*wanted)) return;
  report.error("out-of-range", {option, 0, 0},
               "an image must be 1 to " + std::to_string(kMaximumImageSize) + " pixels wide and high, not " +
                   std::to_string(wanted->first) + "x" + std::to_string(wanted->second));
}

std::optional<Extent3> multiplied(const std::optional<Extent3>& extent, const Extent3& times) {
  if (!extent) return std::nullopt;
  return Extent3{extent->width * times.width, extent->height * times.height, extent->depth * times.depth};
}

}  // namespace

Extent3 wanted_size(const SizeSpec& own, const std::optional<std::pair<uint32_t, uint32_t>>& wanted) {
  if (wanted && can_be(*wanted)) return {wanted->first, wanted->second, 1};
  return {own.width, own.height, 1};
}

ShapeResolver::ShapeResolver(const Nodes& nodes, const Wiring& wiring, EdgeResolver& edges, const Input& input,
                             Report& report)
    : nodes_(nodes),
      wiring_(wiring),
      edges_(edges),
      input_(input),
      report_(report),
      view_(wanted_size(input.spec.view, input.options.view)),
      trace_(wanted_size(input.spec.trace, input.options.trace)) {
  check_size(input.options.view, "--size", report);
  check_size(input.options.trace, "--trace-size", report);
}

std::optional<Extent3> ShapeResolver::extent_of(const ImageRef& image) {
  std::vector<std::pair<ImageRef, Extent3>> alike;  // each has so often the size of the next
  Rule rule{std::nullopt, image};
  while (rule.like) {
    const ImageRef port{rule.like->node, rule.like->port, 0};
    const auto [known, is_new] = known_.try_emplace(port);
    if (is_new) {
      rule = rule_of(port.node, *port.port);
      alike.emplace_back(port, rule.times);
      continue;
    }
    if (known->second.in_progress)
      report_.error("unknown-shape", nodes_.list[port.node].spec->where,
                    "the size of '" + nodes_.list[port.node].spec->name + "." + port.port->name + "' depends on itself",
                    "give a pass of this loop an input of known size");
    rule = {known->second.extent, std::nullopt};
  }
  std::optional<Extent3> extent = rule.extent;
  for (; !alike.empty(); alike.pop_back()) {
    const auto& [port, times] = alike.back();
    extent = multiplied(extent, times);
    known_[port] = {false, extent};
  }
  return extent;
}

Extent3 ShapeResolver::grid(const Node& node) const {
  const int64_t resolution = node.resolved.integer("resolution");
  if (input_.environment.grid_extent) return input_.environment.grid_extent(resolution);
  const auto edge = static_cast<uint32_t>(resolution);
  return {edge, edge, edge};
}

ShapeResolver::Rule ShapeResolver::rule_of(uint32_t index, const Port& port) {
  switch (port.extent) {
    case ExtentRule::view:
      return {view_, std::nullopt};
    case ExtentRule::trace:
      return {trace_, std::nullopt};
    case ExtentRule::grid:
      return {grid(nodes_.list[index]), std::nullopt};
    case ExtentRule::any:
      return {};
    case ExtentRule::fixed:
      return {port.fixed_extent, std::nullopt};
    case ExtentRule::like:
      break;
  }
  return like_input(index, port);
}

ResolvedInput ShapeResolver::input_of(uint32_t index, const Port& port) {
  for (const ResolvedInput& input : wiring_.inputs[index])
    if (input.port == &port) return input;
  return edges_.resolve_input(index, port);  // of a disabled pass, which nobody has wired
}

ShapeResolver::Rule ShapeResolver::like_input(uint32_t index, const Port& port) {
  const Node& node = nodes_.list[index];
  const Port& like = *node.type->find_port(port.like, Direction::in);
  const ResolvedInput model = input_of(index, like);
  if (model.state == Connection::connected) return {std::nullopt, model.sources.front().image, port.times};
  if (like.optional && model.state != Connection::broken) return {multiplied(view_, port.times), std::nullopt};
  // An enabled pass's missing or broken input has been reported as such.
  if (!node.enabled() && model.state != Connection::broken)
    report_.error("unknown-shape", node.spec->where,
                  "disabled pass '" + node.spec->name + "' cannot be replaced by a constant: the size of '" +
                      port.name + "' is that of its input '" + port.like + "', which has no source",
                  "connect '" + port.like + "'");
  return {};
}

void ShapeResolver::check_inputs(uint32_t index, const std::vector<ResolvedInput>& inputs) {
  const Node& node = nodes_.list[index];
  for (const ResolvedInput& input : inputs) {
    if (input.state != Connection::connected || input.port->extent == ExtentRule::any) continue;
    const std::optional<Extent3> given = extent_of(input.sources.front().image);
    const Rule rule = rule_of(index, *input.port);
    const std::optional<Extent3> wanted = rule.like ? multiplied(extent_of(*rule.like), rule.times) : rule.extent;
    if (!given || !wanted || *given == *wanted) continue;
    std::string model;
    if (input.port->extent == ExtentRule::like) {
      const auto other = std::find_if(inputs.begin(), inputs.end(), [&](const ResolvedInput& candidate) {
        return candidate.port->name == input.port->like;
      });
      model = (input.port->times == Extent3{} ? "that" : to_string(input.port->times) + " times that") + " of input '" +
              input.port->like + "', which is " + image_name(nodes_, other->sources.front().image);
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
