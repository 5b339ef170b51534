#include <algorithm>
#include <map>

#include "framework/base/text.hpp"
#include "framework/graph/link_state.hpp"

namespace lightloom::linking {
namespace {

struct NamedImage {
  std::string port_name;  ///< "pass.port"
  std::string full_name;  ///< "pass.port.part", the same for a single image
  ImageRef image;
};

std::vector<NamedImage> all_images(const Nodes& nodes) {
  std::vector<NamedImage> images;
  for (uint32_t i = 0; i < nodes.list.size(); ++i) {
    if (nodes.list[i].type == nullptr) continue;
    for (const Port& port : nodes.list[i].type->ports) {
      if (port.direction == Direction::in) continue;
      for (uint32_t part = 0; part < port.parts.size(); ++part) {
        const ImageRef image{i, &port, part};
        images.push_back({nodes.list[i].spec->name + "." + port.name, image_name(nodes, image), image});
      }
    }
  }
  return images;
}

void find_captures(const Nodes& nodes, const std::vector<std::string>& globs, Needs& needs, Report& report,
                   std::vector<std::string>& notes) {
  const std::vector<NamedImage> images = globs.empty() ? std::vector<NamedImage>{} : all_images(nodes);
  std::vector<bool> captured(images.size(), false);
  for (const std::string& glob : globs) {
    bool disabled = false;
    bool enabled = false;
    for (std::size_t i = 0; i < images.size(); ++i) {
      if (!glob_match(glob, images[i].port_name) && !glob_match(glob, images[i].full_name)) continue;
      const bool runs = nodes.list[images[i].image.node].enabled();
      (runs ? enabled : disabled) = true;
      captured[i] = captured[i] || runs;
    }
    if (enabled) continue;
    if (disabled) {
      notes.push_back("--dump " + in_quotes(glob) + " names disabled passes alone, which have no values of their own");
      continue;
    }
    std::vector<std::string> names;
    for (const NamedImage& image : images)
      if (names.empty() || names.back() != image.port_name) names.push_back(image.port_name);
    report.error("no-match", {"--dump", 0, 0}, in_quotes(glob) + " matches no value",
                 did_you_mean(glob, names, "values are named pass.port"));
  }
  for (std::size_t i = 0; i < images.size(); ++i)
    if (captured[i]) needs.captures.push_back(images[i].image);
}

/// Where a pass that is not needed leads to an input that its consumer's params make it ignore, that is why.
void explain_culled(const Nodes& nodes, const Wiring& wiring, Needs& needs) {
  needs.culled.resize(nodes.list.size());
  std::vector<uint32_t> open;
  const auto explain = [&](uint32_t node, const std::string& why) {
    if (needs.live[node] || !needs.culled[node].empty()) return;
    needs.culled[node] = why;
    open.push_back(node);
  };
  for (uint32_t i = 0; i < nodes.list.size(); ++i)
    for (const ResolvedInput& input : wiring.inputs[i])
      for (const Source& source : input.ignored)
        if (needs.live[i] && !source.constant)
          explain(source.image.node, "only input '" + input.port->name + "' of '" + nodes.list[i].spec->name +
                                         "' leads to it, which with its params does not read that");
  while (!open.empty()) {
    const uint32_t node = open.back();
    open.pop_back();
    for (const ResolvedInput& input : wiring.inputs[node])
      for (const std::vector<Source>* sources : {&input.sources, &input.ignored})
        for (const Source& source : *sources)
          if (!source.constant) explain(source.image.node, needs.culled[node]);
  }
  for (uint32_t i = 0; i < nodes.list.size(); ++i)
    if (!needs.live[i] && needs.culled[i].empty()) needs.culled[i] = "no output, capture or side effect needs it";
}

}  // namespace

Needs find_needs(const Nodes& nodes, const Wiring& wiring, const LinkOptions& options, Report& report,
                 std::vector<std::string>& notes) {
  Needs needs;
  needs.live.resize(nodes.list.size(), false);
  find_captures(nodes, options.captures, needs, report, notes);
  std::vector<uint32_t> open;
  const auto need = [&](uint32_t node) {
    if (needs.live[node]) return;
    needs.live[node] = true;
    open.push_back(node);
  };
  for (uint32_t i = 0; i < nodes.list.size(); ++i)
    if (nodes.list[i].enabled() && nodes.list[i].type != nullptr && nodes.list[i].type->side_effect) need(i);
  for (const ResolvedOutput& output : wiring.outputs)
    if (output.state == Connection::connected && !output.source.constant) need(output.source.image.node);
  for (const ImageRef& image : needs.captures) need(image.node);
  while (!open.empty()) {
    const uint32_t node = open.back();
    open.pop_back();
    for (const ResolvedInput& input : wiring.inputs[node])
      for (const Source& source : input.sources)
        if (!source.constant) need(source.image.node);
  }
  explain_culled(nodes, wiring, needs);
  return needs;
}

void check_bypasses(const Nodes& nodes, const Wiring& wiring, const Needs& needs, Report& report) {
  std::map<std::pair<uint32_t, const Port*>, std::vector<std::string>> consumers;
  for (uint32_t i = 0; i < wiring.inputs.size(); ++i)
    for (const ResolvedInput& input : wiring.inputs[i])
      if (needs.live[i] && input.state == Connection::no_bypass && !input.port->optional)
        consumers[{input.culprit.node, input.culprit.port}].push_back("input '" + input.port->name + "' of '" +
                                                                      nodes.list[i].spec->name + "'");
  for (const ResolvedOutput& output : wiring.outputs)
    if (output.state == Connection::no_bypass)
      consumers[{output.culprit.node, output.culprit.port}].push_back("output '" + output.spec->name +
                                                                      "' of the graph");
  for (const auto& [culprit, names] : consumers) {
    const Node& node = nodes.list[culprit.first];
    const Port& port = *culprit.second;
    const std::string why = port.bypass ? "whose replacement, input '" + port.bypass->input + "', has no source,"
                                        : "which nothing can replace,";
    report.error("no-bypass", node.disabled_where,
                 "pass '" + node.spec->name + "' is off (" + node.disabled + "), but its output '" + port.name + "', " +
                     why + " is needed by " + join(names, ", "),
                 "let it run, or disable what needs it as well");
  }
}

}  // namespace lightloom::linking
