#include <gtest/gtest.h>

#include <algorithm>

#include "framework/graph/link.hpp"
#include "tests/support/toy_graphs.hpp"

namespace lightloom {
namespace {

using toy::file;
using toy::graph_of;
using toy::link_text;
using toy::plan_of;
using toy::source;

const std::string kSource = R"("s": {"type": "source"})";

LinkOptions disable(std::vector<std::string> globs) {
  LinkOptions options;
  options.disables = std::move(globs);
  return options;
}

std::vector<std::string> culled(const Graph& graph) {
  std::vector<std::string> names;
  for (const PassRemark& remark : graph.culled) names.push_back(remark.pass);
  return names;
}

using Names = std::vector<std::string>;

TEST(Bypass, EqualsTheGraphWithTheNodeRemovedByHand) {
  const std::string s = kSource + ", ";
  const std::string end = R"("m": {"type": "mix", "in": {"x": "%.a", "y": "s.a"}})";
  const auto tail = [&](std::string name) { return std::string(end).replace(end.find('%'), 1, name); };
  const std::string f = R"("f": {"type": "filter", "in": {"x": "s.a"}}, )";
  const std::string g = R"("g": {"type": "blur", "in": {"x": "f.a"}}, )";
  const std::string g_alone = R"("g": {"type": "blur", "in": {"x": "s.a"}}, )";
  const std::string out = R"("o": "m.a")";
  const std::string whole = file(s + f + g + tail("g"), out);
  EXPECT_EQ(plan_hash(plan_of(whole, disable({"f"}))), plan_hash(plan_of(file(s + g_alone + tail("g"), out))));
  EXPECT_EQ(plan_hash(plan_of(whole, disable({"g"}))), plan_hash(plan_of(file(s + f + tail("f"), out))));
  EXPECT_EQ(plan_hash(plan_of(whole, disable({"f", "g"}))), plan_hash(plan_of(file(s + tail("s"), out))));
  EXPECT_NE(plan_hash(plan_of(whole)), plan_hash(plan_of(whole, disable({"f"}))));
}

TEST(Bypass, HistoryOfABypassedOutputIsThatOfItsSource) {
  const std::string tail = R"("t": {"type": "trail", "in": {"x": "s.a", "past": "%.a@2..4"}})";
  const std::string whole = file(kSource + R"(, "f": {"type": "filter", "in": {"x": "s.a@1"}}, )" +
                                     std::string(tail).replace(tail.find('%'), 1, "f"),
                                 R"("o": "t.a", "p": "f.a")");
  const Graph graph = graph_of(whole, disable({"f"}));
  EXPECT_EQ(source(graph, "t", "past"), "s.a@3..5");
  EXPECT_EQ(graph.outputs[1].age, 1U);
  EXPECT_EQ(plan_hash(compile(graph)),
            plan_hash(plan_of(file(kSource + R"(, "t": {"type": "trail", "in": {"x": "s.a", "past": "s.a@3..5"}})",
                                   R"("o": "t.a", "p": "s.a@1")"))));
}

TEST(Bypass, ReachesBackNoFurtherThanTheLimit) {
  const std::string text = file(kSource + R"(, "f": {"type": "filter", "in": {"x": "s.a@9"}},
      "g": {"type": "filter", "in": {"x": "f.a@9"}})",
                                R"("o": "g.a")");
  EXPECT_TRUE(link_text(text).graph);
  EXPECT_EQ(link_text(text, disable({"f"})).codes(), Names{"out-of-range"});
}

TEST(Bypass, PassesEveryPartOfABundle) {
  const Graph graph = graph_of(file(R"("r": {"type": "raster"}, "q": {"type": "pairs", "in": {"p": "r.p"}},
      "k": {"type": "pick", "in": {"p": "q.p"}}, "f": {"type": "filter", "in": {"x": "q.p.u"}})",
                                    R"("o": "k.a", "n": "f.a")"),
                               disable({"q"}));
  EXPECT_EQ(source(graph, "k", "p", "u"), "r.p.u");
  EXPECT_EQ(source(graph, "k", "p", "v"), "r.p.v");
  EXPECT_EQ(source(graph, "f", "x"), "r.p.u");
}

TEST(Bypass, ConstantTakesTheOutputsShape) {
  const Graph graph = graph_of(file(R"("t": {"type": "small"}, "b": {"type": "black", "in": {"x": "t.a"}},
      "f": {"type": "filter", "in": {"x": "b.a"}})",
                                    R"("o": "f.a")"),
                               disable({"b"}));
  EXPECT_EQ(culled(graph), Names{"t"});
  const Value& value = graph.values[toy::pass(graph, "f").inputs[0].value];
  EXPECT_EQ(value_name(value), "b.a");
  EXPECT_EQ(to_string(value.desc.extent), "32x24");
  EXPECT_EQ(value.constant, (ClearColor{0, 0, 0, 1}));
  EXPECT_EQ(value.history, 0U);
}

TEST(Bypass, OptionalInputsOfAPassWithoutBypassAreLeftOpen) {
  const Graph graph = graph_of(file(kSource + R"(, "m": {"type": "mix", "in": {"x": "s.a", "y": "s.a"}},
      "f": {"type": "filter", "in": {"x": "s.a", "y": "m.a"}})",
                                    R"("o": "f.a")"),
                               disable({"m"}));
  EXPECT_EQ(source(graph, "f", "y"), "");
  EXPECT_EQ(toy::pass(graph, "f").unconnected, Names{"y"});
}

TEST(Bypass, MissingBypassNamesTheConsumersThatRun) {
  const toy::Result result = link_text(file(kSource + R"(, "m": {"type": "mix", "in": {"x": "s.a", "y": "s.a"}},
      "f": {"type": "filter", "in": {"x": "m.a"}}, "g": {"type": "filter", "in": {"x": "f.a", "y": "m.a"}},
      "unneeded": {"type": "filter", "in": {"x": "m.a"}})",
                                            R"("o": "g.a", "direct": "m.a")"),
                                       disable({"m"}));
  ASSERT_EQ(result.codes(), Names{"no-bypass"}) << result.text();
  const Diagnostic& problem = result.diagnostics.all().front();
  EXPECT_EQ(problem.where, (SourceLocation{"--disable", 0, 0}));
  EXPECT_NE(problem.message.find("input 'x' of 'f'"), std::string::npos) << problem.message;
  EXPECT_NE(problem.message.find("output 'direct'"), std::string::npos) << problem.message;
  EXPECT_EQ(problem.message.find("unneeded"), std::string::npos) << problem.message;
}

TEST(Bypass, DisabledPassWithoutConsumersIsGone) {
  const Graph graph =
      graph_of(file(kSource + R"(, "m": {"type": "mix", "in": {"x": "s.a"}, "enabled": false})", R"("o": "s.a")"));
  ASSERT_EQ(graph.bypassed.size(), 1U);
  EXPECT_EQ(graph.bypassed[0].pass, "m");
  EXPECT_EQ(graph.passes.size(), 1U);
}

TEST(Bypass, CircleOfDisabledPassesIsReported) {
  const std::string text =
      file(R"("f": {"type": "filter", "in": {"x": "g.a@1"}}, "g": {"type": "filter", "in": {"x": "f.a"}},
      "h": {"type": "filter", "in": {"x": "g.a"}})",
           R"("o": "h.a")");
  EXPECT_EQ(link_text(text, disable({"f", "g"})).codes(), Names{"cycle"});
}

TEST(Bypass, WaysToDisableAreOneMechanism) {
  const std::string before = kSource + R"(, "f": {"type": "filter", "in": {"x": "s.a"})";
  const std::string after = R"(}, "g": {"type": "filter", "in": {"x": "f.a"}})";
  const std::string out = R"("o": "g.a")";
  const std::string variants = R"("variants": {"v": {"disable": ["f"]}},)";
  const uint64_t by_option = plan_hash(plan_of(file(before + after, out), disable({"f"})));
  EXPECT_EQ(plan_hash(plan_of(file(before + R"(, "enabled": false)" + after, out))), by_option);
  EXPECT_EQ(plan_hash(plan_of(file(before + R"(, "when": "!scene.sun")" + after, out))), by_option);
  LinkOptions variant;
  variant.variants = {"v"};
  EXPECT_EQ(plan_hash(plan_of(file(before + after, out, variants), variant)), by_option);
  EXPECT_NE(plan_hash(plan_of(file(before + R"(, "when": "scene.sun")" + after, out))), by_option);
}

}  // namespace
}  // namespace lightloom
