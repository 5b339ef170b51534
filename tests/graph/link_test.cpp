#include "framework/graph/link.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/toy_graphs.hpp"

namespace lightloom {
namespace {

using toy::file;
using toy::graph_of;
using toy::source;

const std::string kSource = R"("s": {"type": "source"})";

LinkOptions capture(std::vector<std::string> globs) {
  LinkOptions options;
  options.captures = std::move(globs);
  return options;
}

std::vector<std::string> culled(const Graph& graph) {
  std::vector<std::string> names;
  for (const PassRemark& remark : graph.culled) names.push_back(remark.pass);
  return names;
}

std::vector<std::string> captured(const Graph& graph) {
  std::vector<std::string> names;
  for (const ValueId id : graph.captures) names.push_back(value_name(graph.values[id]));
  return names;
}

using Names = std::vector<std::string>;

TEST(Link, UsesAreInDeclaredOrderWithShaderNames) {
  const Graph graph = graph_of(file(R"("r": {"type": "raster"}, "k": {"type": "pick", "in": {"p": "r.p"}},
      "q": {"type": "pairs", "in": {"p": "r.p"}}, "j": {"type": "filter", "in": {"x": "q.p.u"}})",
                                    R"("o": "k.a", "n": "j.a")"));
  const GraphPass& pairs = toy::pass(graph, "q");
  ASSERT_EQ(pairs.inputs.size(), 2U);
  EXPECT_EQ(pairs.inputs[0].shader_name, "p_u");
  EXPECT_EQ(pairs.inputs[1].shader_name, "p_v");
  EXPECT_EQ(pairs.outputs[0].shader_name, "out_p_u");
  EXPECT_EQ(toy::pass(graph, "r").scratch[0].shader_name, "depth");
  EXPECT_EQ(toy::pass(graph, "j").inputs[0].shader_name, "x");
  EXPECT_EQ(toy::pass(graph, "j").unconnected, Names{"y"});
  EXPECT_EQ(source(graph, "j", "x"), "q.p.u");
  EXPECT_EQ(graph.values[pairs.outputs[1].value].desc.format, Format::r32_uint);
}

TEST(Link, ShapesFollowTheirRules) {
  LinkOptions options;
  options.view = {10, 20};
  const Graph graph =
      graph_of(file(kSource + R"(, "t": {"type": "small"}, "f": {"type": "filter", "in": {"x": "t.a", "y": "s.a"}},
          "v": {"type": "volume", "params": {"resolution": 7}}, "c": {"type": "carve", "in": {"v": "v.v"}})",
                    R"("o": "f.a", "p": "s.a", "w": "c.v")"),
               options);
  const auto extent = [&](const std::string& name) {
    const auto found = std::find_if(graph.values.begin(), graph.values.end(),
                                    [&](const Value& value) { return value_name(value) == name; });
    return found == graph.values.end() ? "none" : to_string(found->desc.extent);
  };
  EXPECT_EQ(extent("s.a"), "10x20");
  EXPECT_EQ(extent("t.a"), "32x24");
  EXPECT_EQ(extent("f.a"), "32x24");
  EXPECT_EQ(extent("v.v"), "7x4x7");
  EXPECT_EQ(graph.trace.width, 32u);
  options.trace = {30, 40};
  EXPECT_EQ(graph_of(file(kSource, R"("p": "s.a")"), options).trace.height, 40u);
  EXPECT_EQ(extent("c.v"), "7x4x7");
  EXPECT_EQ(to_string(graph.view), "10x20");
}

TEST(Link, AnOutputLikeAnOptionalInputIsAsLargeAsTheViewWithoutIt) {
  PassRegistry types = toy::registry();
  PassType maybe = *types.find("filter");
  maybe.name = "maybe";
  maybe.ports[0].optional = true;
  types.add(maybe);
  LinkOptions options;
  options.view = {10, 20};
  const Graph graph = graph_of(file(R"("t": {"type": "small"}, "m": {"type": "maybe", "in": {"x": "t.a"}},
      "n": {"type": "maybe"}, "d": {"type": "maybe", "in": {"x": "n.a"}})",
                                    R"("o": "m.a", "p": "n.a", "q": "d.a")"),
                               options, types);
  const auto extent = [&](const char* name) {
    return graph.values[toy::pass(graph, name).outputs.front().value].desc.extent;
  };
  EXPECT_NE(extent("m"), (Extent3{10, 20, 1}));
  EXPECT_EQ(extent("m"), graph.values[toy::pass(graph, "t").outputs.front().value].desc.extent);
  EXPECT_EQ(extent("n"), (Extent3{10, 20, 1}));
  EXPECT_EQ(extent("d"), (Extent3{10, 20, 1}));
}

TEST(Link, RingsHoldTheOldestAgeThatIsRead) {
  const Graph graph = graph_of(file(kSource + R"(, "f": {"type": "filter", "in": {"x": "s.a@2"}},
      "t": {"type": "trail", "in": {"x": "f.a", "past": "s.a@1..5"}})",
                                    R"("o": "t.a", "old": "f.a@3")"));
  EXPECT_EQ(graph.values[toy::pass(graph, "s").outputs[0].value].history, 5U);
  EXPECT_EQ(graph.values[toy::pass(graph, "f").outputs[0].value].history, 3U);
  EXPECT_EQ(graph.values[toy::pass(graph, "t").outputs[0].value].history, 0U);
  EXPECT_EQ(graph.outputs[1].age, 3U);
  EXPECT_TRUE(toy::pass(graph, "t").inputs[1].array);
}

TEST(Link, WhatNothingNeedsIsCulledUnlessItIsARoot) {
  const std::string text = file(kSource + R"(, "a": {"type": "filter", "in": {"x": "s.a"}},
      "b": {"type": "filter", "in": {"x": "a.a"}}, "c": {"type": "filter", "in": {"x": "b.a"}},
      "k": {"type": "sink", "in": {"x": "s.a"}})",
                                R"("o": "a.a")");
  EXPECT_EQ(culled(graph_of(text)), (Names{"b", "c"}));
  EXPECT_EQ(culled(graph_of(text, capture({"b.a"}))), Names{"c"});
  EXPECT_EQ(culled(graph_of(text, capture({"*"}))), Names{});
}

TEST(Link, HistoryKeepsItsProducerAlive) {
  const Graph graph = graph_of(file(kSource + R"(, "l": {"type": "filter", "in": {"x": "f.a"}},
      "f": {"type": "filter", "in": {"x": "s.a", "y": "l.a@1"}})",
                                    R"("o": "f.a")"));
  EXPECT_EQ(culled(graph), Names{});
  EXPECT_EQ(source(graph, "f", "y"), "l.a@1");
}

TEST(Link, CapturesExpandToValuesOfPassesThatRun) {
  const std::string text = file(R"("r": {"type": "raster"}, "q": {"type": "pairs", "in": {"p": "r.p"}},
      "f": {"type": "filter", "in": {"x": "q.p.u"}})",
                                R"("o": "f.a")");
  EXPECT_EQ(captured(graph_of(text, capture({"r.*"}))), (Names{"r.p.u", "r.p.v", "r.depth"}));
  EXPECT_EQ(captured(graph_of(text, capture({"?.p"}))), (Names{"r.p.u", "r.p.v", "q.p.u", "q.p.v"}));
  EXPECT_EQ(captured(graph_of(text, capture({"*.u", "r.p.u"}))), (Names{"r.p.u", "q.p.u"}));
  LinkOptions options = capture({"q.*"});
  options.disables = {"q"};
  const Graph graph = graph_of(text, options);
  EXPECT_EQ(captured(graph), Names{});
  EXPECT_EQ(graph.notes.size(), 1U);
}

}  // namespace
}  // namespace lightloom
