#include "tests/support/toy_graphs.hpp"

#include <gtest/gtest.h>

namespace lightloom::toy {
namespace {

Port input(const std::string& name, Access access = Access::compute_sampled_read) {
  Port port;
  port.name = name;
  port.parts = {{"", Format::rgba16_sfloat, ""}};
  port.access = access;
  return port;
}

Port output(const std::string& name, ExtentRule extent, const std::string& like = {}) {
  Port port = input(name, Access::compute_storage_write);
  port.direction = Direction::out;
  port.extent = extent;
  port.like = like;
  return port;
}

Port like_x(const std::string& name) {
  Port port = input(name);
  port.extent = ExtentRule::like;
  port.like = "x";
  return port;
}

Port bypassed(Port port, const std::string& source) {
  port.bypass = Bypass{source, {}};
  return port;
}

Port pair(Port port) {
  port.bundle = "pair";
  port.parts = {{"u", Format::rgba16_sfloat, ""}, {"v", Format::r32_uint, ""}};
  return port;
}

Port volume(Port port) {
  port.dimension = Dimension::d3;
  return port;
}

Port scratch(const std::string& name, ExtentRule extent, const std::string& like, Access access) {
  Port port = output(name, extent, like);
  port.direction = Direction::scratch;
  port.access = access;
  return port;
}

Port attachment(Port port) {
  port.access = Access::color_attachment_write;
  return port;
}

Param strength() {
  return {"strength", ParamType::real, 1.0, 0, 10, {}, "", ""};
}

PassType type(const std::string& name, std::vector<Port> ports, std::vector<Param> params = {}) {
  PassType result;
  result.name = name;
  result.ports = std::move(ports);
  result.params = std::move(params);
  result.record = [](PassContext&) {};
  return result;
}

/// Gives something else in each frame.
PassType moving(PassType result) {
  result.reads = FrameState::camera;
  return result;
}

PassType still(PassType result) {
  result.reads = FrameState::static_geometry | FrameState::materials;
  return result;
}

Port kept(Port port) {
  port.persistent = true;
  return port;
}

void add_sources(PassRegistry& types) {
  types.add(still(type("still", {output("a", ExtentRule::view)})));
  PassType body = type("body", {output("a", ExtentRule::view)},
                       {{"geometry", ParamType::choice, std::string("static"), {}, {}, {"static", "dynamic"}, "", ""}});
  body.reads = FrameState::static_geometry | FrameState::dynamic_geometry;
  body.reads_with = [](const ParamSet& params) {
    return params.choice("geometry") == "static" ? FrameState::static_geometry : FrameState::dynamic_geometry;
  };
  types.add(body);
  types.add(moving(type("source", {output("a", ExtentRule::view)},
                        {{"level", ParamType::real, 0.5, 0, 1, {}, "", ""},
                         {"count", ParamType::integer, int64_t{2}, 1, 8, {}, "pixels", ""},
                         {"mode", ParamType::choice, std::string("one"), {}, {}, {"one", "two"}, "", ""},
                         {"flag", ParamType::boolean, false, {}, {}, {}, "", ""}})));
  types.add(moving(type("small", {output("a", ExtentRule::trace)})));
  Port ids = output("a", ExtentRule::view);
  ids.parts = {{"", Format::r32_uint, ""}};
  types.add(moving(type("ids", {ids})));
  types.add(moving(type("raster", {attachment(pair(output("p", ExtentRule::view))),
                                   scratch("depth", ExtentRule::view, "", Access::depth_attachment_write)})));
  types.add(moving(type("volume", {volume(output("v", ExtentRule::grid))},
                        {{"resolution", ParamType::integer, int64_t{16}, 1, 512, {}, "voxels", ""}})));
}

void add_filters(PassRegistry& types) {
  const Port like = output("a", ExtentRule::like, "x");
  Port optional = input("y");
  optional.optional = true;
  types.add(type("filter", {input("x"), optional, bypassed(like, "x")}, {strength()}));
  types.add(type("blur", {input("x"), bypassed(like, "x")},
                 {strength(), {"taps", ParamType::integer, int64_t{5}, 1, 99, {}, "", ""}}));
  types.add(type("mix", {input("x"), like_x("y"), like,
                         scratch("tmp", ExtentRule::like, "x", Access::compute_storage_read_write)}));
  types.add(type("patch", {input("x"), kept(bypassed(like, "x")),
                           kept(scratch("memo", ExtentRule::like, "x", Access::compute_storage_read_write))}));
  Port black = like;
  black.bypass = Bypass{"", {0, 0, 0, 1}};
  types.add(type("black", {input("x"), black}));
  Port past = input("past");
  past.array = true;
  types.add(type("trail", {input("x"), past, bypassed(like, "x")}));
  types.add(type("accumulate", {input("x"), like_x("last"), bypassed(like, "x")}));
  types.add(type("pairs", {pair(input("p")), bypassed(pair(output("p", ExtentRule::like, "p")), "p")}));
  types.add(type("pick", {pair(input("p")), output("a", ExtentRule::like, "p")}));
  types.add(type("shade", {input("x", Access::fragment_sampled_read), attachment(like)}));
  types.add(type("carve", {volume(input("v")), volume(bypassed(output("v", ExtentRule::like, "v"), "v"))}));
  Port choosy = optional;
  choosy.needed_with = [](const ParamSet& params) { return params.choice("reading") == "both"; };
  types.add(type("choosy", {input("x"), choosy, bypassed(like, "x")},
                 {{"reading", ParamType::choice, std::string("one"), {}, {}, {"one", "both"}, "", ""}}));
  types.add(type("strange", {input("x"), pair(optional), bypassed(like, "x")},
                 {{"strength", ParamType::choice, std::string("weak"), {}, {}, {"weak", "strong"}, "", ""},
                  {"taps", ParamType::real, 1.0, 0, 10, {}, "", ""}}));
  PassType sink = type("sink", {input("x"), scratch("log", ExtentRule::like, "x", Access::compute_storage_write)});
  sink.side_effect = true;
  types.add(sink);
}

}  // namespace

const PassRegistry& registry() {
  static const PassRegistry types = [] {
    PassRegistry result;
    add_sources(result);
    add_filters(result);
    return result;
  }();
  return types;
}

std::vector<std::string> Result::codes() const {
  std::vector<std::string> codes;
  for (const Diagnostic& diagnostic : diagnostics.sorted()) codes.push_back(diagnostic.code);
  return codes;
}

std::string Result::text() const {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics.sorted()) text += format_diagnostic(diagnostic) + "\n";
  return text;
}

LinkEnvironment environment(bool dynamic) {
  return {[](int64_t resolution) {
            const auto edge = static_cast<uint32_t>(resolution);
            return Extent3{edge, edge / 2 + 1, edge};
          },
          {{"dynamic", dynamic}, {"sun", true}},
          dynamic ? kChangingState : FrameState::camera | FrameState::time | FrameState::seed | FrameState::lights};
}

Result link_text(const std::string& text, const LinkOptions& options, const PassRegistry& types,
                 const LinkEnvironment& against) {
  Result result;
  const std::optional<GraphSpec> spec = parse_graph(text, "g", result.diagnostics);
  if (spec) result.graph = link(*spec, types, options, against, result.diagnostics);
  return result;
}

std::string file(const std::string& passes, const std::string& outputs, const std::string& rest) {
  return "{\"lightloom\": 1, \"name\": \"toy\", \"view\": {\"width\": 64, \"height\": 48},\n"
         "\"trace\": {\"width\": 32, \"height\": 24},\n" +
         rest + "\n\"passes\": {\n" + passes + "\n},\n\"outputs\": {" + outputs + "}}";
}

Graph graph_of(const std::string& text, const LinkOptions& options, const PassRegistry& types,
               const LinkEnvironment& against) {
  const Result result = link_text(text, options, types, against);
  EXPECT_TRUE(result.graph.has_value()) << result.text() << text;
  return result.graph.value_or(Graph{});
}

Plan plan_of(const std::string& text, const LinkOptions& options) {
  return compile(graph_of(text, options));
}

std::vector<std::string> order(const Plan& plan) {
  std::vector<std::string> names;
  for (const PlanStep& step : plan.steps) names.push_back(plan.graph.passes[step.pass].name);
  return names;
}

const GraphPass& pass(const Graph& graph, const std::string& name) {
  static const GraphPass none;
  for (const GraphPass& candidate : graph.passes)
    if (candidate.name == name) return candidate;
  ADD_FAILURE() << "the graph has no pass " << name;
  return none;
}

std::string source(const Graph& graph, const std::string& pass_name, const std::string& port, const std::string& part) {
  for (const Use& use : pass(graph, pass_name).inputs) {
    if (use.port != port || use.part != part) continue;
    std::string text = value_name(graph.values[use.value]);
    if (use.first_age > 0) text += "@" + std::to_string(use.first_age);
    if (use.last_age > use.first_age) text += ".." + std::to_string(use.last_age);
    return text;
  }
  return {};
}

}  // namespace lightloom::toy
