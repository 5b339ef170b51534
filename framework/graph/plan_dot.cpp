#include "framework/graph/plan_dot.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "framework/base/text.hpp"

namespace lightloom {
namespace {

/// A quoted ID or label of the DOT language; a line break in `text` is one in the drawing.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (c == '\n')
      result += "\\n";
    else
      result += c;
  }
  return result + "\"";
}

std::string age_text(uint32_t first, uint32_t last) {
  if (last == 0) return "";
  return "@" + std::to_string(first) + (last > first ? ".." + std::to_string(last) : "");
}

class DotWriter {
 public:
  explicit DotWriter(const Plan& plan) : plan_(plan), graph_(plan.graph) {}

  std::string run() {
    out_ << "// dot -Tsvg draws it\ndigraph " << quoted(graph_.name) << " {\n"
         << "  graph [rankdir=TB, fontname=\"sans-serif\", nodesep=0.3, ranksep=0.35];\n"
         << "  node [fontname=\"sans-serif\", fontsize=11];\n"
         << "  edge [fontname=\"sans-serif\", fontsize=9, color=\"#5b6470\"];\n";
    once();
    for (const PlanStep& step : plan_.steps) pass(step, "  ");
    constants();
    for (const auto* steps : {&plan_.once, &plan_.steps})
      for (const PlanStep& step : *steps) edges(graph_.passes[step.pass]);
    outputs();
    remarks("culled", graph_.culled);
    remarks("bypassed", graph_.bypassed);
    out_ << "}\n";
    return out_.str();
  }

 private:
  static std::string pass_id(const std::string& name) { return quoted("pass " + name); }
  static std::string port_id(const Value& value) { return quoted("value " + value.pass + "." + value.port); }

  void once() {
    if (plan_.once.empty()) return;
    out_ << "  subgraph cluster_once {\n    label=\"once, in the first frame\";\n    style=\"rounded,filled\";\n"
         << "    color=\"#c9b458\";\n    fillcolor=\"#fbf6dd\";\n    fontsize=11;\n";
    for (const PlanStep& step : plan_.once) pass(step, "    ");
    out_ << "  }\n";
  }

  void pass(const PlanStep& step, const std::string& indent) {
    const GraphPass& pass = graph_.passes[step.pass];
    const std::string tooltip = pass.once.empty() ? pass.type->doc : pass.once;
    out_ << indent << pass_id(pass.name) << " [shape=box, style=\"rounded,filled\", fillcolor=\"#dbe9f6\", label="
         << quoted(std::to_string(++number_) + ". " + pass.name + "\n" + pass.type->name)
         << ", tooltip=" << quoted(tooltip) << "];\n";
    std::set<std::string> drawn;
    for (const auto* uses : {&pass.outputs, &pass.scratch})
      for (const Use& use : *uses)
        if (drawn.insert(use.port).second) port(graph_.values[use.value], indent);
  }

  /// All parts of a port as one node.
  void port(const Value& value, const std::string& indent) {
    size_t images = 0;
    uint64_t bytes = 0;
    uint32_t layers = 1;
    for (const Value& other : graph_.values) {
      if (other.pass != value.pass || other.port != value.port) continue;
      ++images;
      bytes += byte_size(other);
      layers = std::max(layers, ring_layers(other));
    }
    std::string label = value.pass + "." + value.port + "\n";
    label += images > 1 ? std::to_string(images) + " images " + to_string(value.desc.extent) : to_string(value.desc);
    if (layers > 1) label += ", ring of " + std::to_string(layers);
    std::string style = value.scratch ? "dotted" : "solid";
    if (value.persistent) style += ",bold";
    out_ << indent << port_id(value) << " [shape=ellipse, fontsize=9, style=" << quoted(style)
         << ", color=\"#5b6470\", label=" << quoted(label) << ", tooltip="
         << quoted(std::to_string(bytes) + " bytes" + (value.persistent ? ", kept from frame to frame" : "")) << "];\n";
  }

  void constants() {
    std::set<std::string> drawn;
    for (const Value& value : graph_.values)
      if (value.constant && drawn.insert(port_id(value)).second)
        out_ << "  " << port_id(value) << " [shape=ellipse, fontsize=9, style=filled, fillcolor=\"#eeeeee\", label="
             << quoted(value.pass + "." + value.port + "\nconstant") << "];\n";
  }

  void edges(const GraphPass& pass) {
    std::set<std::string> ports;
    for (const auto* uses : {&pass.outputs, &pass.scratch})
      for (const Use& use : *uses)
        if (ports.insert(use.port).second)
          out_ << "  " << pass_id(pass.name) << " -> " << port_id(graph_.values[use.value]) << ";\n";
    // Parts that are read alike share an edge.
    std::map<std::pair<std::string, std::string>, std::set<std::string>> inputs;
    for (const Use& use : pass.inputs)
      inputs[{port_id(graph_.values[use.value]), age_text(use.first_age, use.last_age)}].insert(use.port);
    for (const auto& [from, names] : inputs) {
      const std::string label = join({names.begin(), names.end()}, ", ") + from.second;
      out_ << "  " << from.first << " -> " << pass_id(pass.name) << " [label=" << quoted(label);
      if (!from.second.empty()) out_ << ", style=dashed, constraint=false";
      out_ << "];\n";
    }
  }

  void outputs() {
    for (const GraphOutput& output : graph_.outputs) {
      const std::string id = quoted("output " + output.name);
      out_ << "  " << id
           << " [shape=box, style=filled, fillcolor=\"#d9efdb\", label=" << quoted(output.name + "\noutput") << "];\n";
      out_ << "  " << port_id(graph_.values[output.value]) << " -> " << id;
      if (output.age > 0) out_ << " [label=" << quoted(age_text(output.age, output.age)) << ", style=dashed]";
      out_ << ";\n";
    }
  }

  void remarks(const std::string& what, const std::vector<PassRemark>& list) {
    for (const PassRemark& remark : list)
      out_ << "  " << pass_id(remark.pass)
           << " [shape=box, style=\"rounded,dashed,filled\", fillcolor=\"#eeeeee\", color=\"#9a9a9a\", "
              "fontcolor=\"#6a6a6a\", label="
           << quoted(remark.pass + "\n" + what) << ", tooltip=" << quoted(remark.reason) << "];\n";
  }

  const Plan& plan_;
  const Graph& graph_;
  std::ostringstream out_;
  size_t number_ = 0;
};

}  // namespace

std::string plan_dot(const Plan& plan) {
  return DotWriter(plan).run();
}

}  // namespace lightloom
