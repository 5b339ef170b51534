#include "framework/graph/link.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/graph/toy_graphs.hpp"

namespace lightloom {
namespace {

using toy::file;
using toy::graph_of;
using toy::link_text;
using toy::order;
using toy::plan_of;
using toy::source;

const std::string kSource = R"("s": {"type": "source"})";

LinkOptions disable(std::vector<std::string> globs) {
  LinkOptions options;
  options.disables = std::move(globs);
  return options;
}

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
  EXPECT_EQ(extent("c.v"), "7x4x7");
  EXPECT_EQ(to_string(graph.view), "10x20");
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

// Bypass -------------------------------------------------------------------------------------------------------------

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

// Variants and options -----------------------------------------------------------------------------------------------

TEST(Swap, KeepsWhatTheNewTypeKnowsAndCullsTheRest) {
  LinkOptions options;
  options.swaps = {{"f", "blur"}};
  const Graph graph = graph_of(file(kSource + R"(, "e": {"type": "source"},
      "f": {"type": "filter", "in": {"x": "s.a", "y": "e.a"}, "params": {"strength": 3}})",
                                    R"("o": "f.a")"),
                               options);
  const GraphPass& swapped = toy::pass(graph, "f");
  EXPECT_EQ(swapped.type->name, "blur");
  EXPECT_EQ(swapped.params.real("strength"), 3.0);
  EXPECT_EQ(swapped.params.integer("taps"), 5);
  EXPECT_EQ(culled(graph), Names{"e"});
  ASSERT_EQ(graph.notes.size(), 1U);
  EXPECT_NE(graph.notes[0].find("input 'y'"), std::string::npos);
}

TEST(Swap, ReportsInputsThatTheNewTypeNeeds) {
  LinkOptions options;
  options.swaps = {{"f", "mix"}};
  const toy::Result result = link_text(
      file(kSource + R"(, "f": {"type": "blur", "in": {"x": "s.a"}, "params": {"taps": 3}})", R"("o": "f.a")"),
      options);
  EXPECT_EQ(result.codes(), Names{"missing-input"}) << result.text();
}

TEST(Options, ApplyInTheirOrder) {
  const std::string text = file(
      R"("s": {"type": "source", "params": {"count": "$n"}}, "f": {"type": "filter", "in": {"x": "s.a"}})",
      R"("o": "f.a")",
      R"("params": {"n": 1}, "variants": {"a": {"set": {"n": 3, "f.strength": 4}}, "b": {"set": {"n": 5}, "swap": {"f": "blur"}}},)");
  const auto count = [&](const LinkOptions& options) {
    return toy::pass(graph_of(text, options), "s").params.integer("count");
  };
  LinkOptions options;
  EXPECT_EQ(count(options), 1);
  options.variants = {"a"};
  EXPECT_EQ(count(options), 3);
  options.variants = {"a", "b"};
  EXPECT_EQ(count(options), 5);
  options.variants = {"b", "a"};
  EXPECT_EQ(count(options), 3);
  options.sets = {{"n", "7"}};
  EXPECT_EQ(count(options), 7);
  options.sets = {{"n", "7"}, {"?.count", "8"}};
  EXPECT_EQ(count(options), 8);
  EXPECT_EQ(toy::pass(graph_of(text, options), "f").params.real("strength"), 4.0);
  EXPECT_EQ(toy::pass(graph_of(text, options), "f").type->name, "blur");
}

TEST(Options, ValueTextsTakeTheParamsType) {
  LinkOptions options;
  options.sets = {{"s.level", "1"}, {"s.mode", "two"}, {"s.flag", "true"}, {"s.count", "4"}, {"level", "0.25"}};
  const GraphPass pass =
      toy::pass(graph_of(file(kSource + R"(, "q": {"type": "source", "params": {"level": "$level"}})",
                              R"("o": "s.a", "p": "q.a")", R"("params": {"level": 1},)"),
                         options),
                "s");
  EXPECT_EQ(pass.params.real("level"), 1.0);
  EXPECT_EQ(pass.params.choice("mode"), "two");
  EXPECT_TRUE(pass.params.boolean("flag"));
}

struct OptionCase {
  const char* what;
  void (*spoil)(LinkOptions&);
  const char* code;
  const char* place;
  const char* hint;
};

TEST(Options, MistakesAreErrorsAtTheOption) {
  const OptionCase cases[] = {
      {"variant", [](LinkOptions& o) { o.variants = {"fest"}; }, "unknown-variant", "--variant", "'fast'"},
      {"disable", [](LinkOptions& o) { o.disables = {"filtre"}; }, "no-match", "--disable", "'filter'"},
      {"swap pass",
       [](LinkOptions& o) {
         o.swaps = {{"filte", "blur"}};
       },
       "no-match", "--swap", "'filter'"},
      {"swap type",
       [](LinkOptions& o) {
         o.swaps = {{"filter", "blurr"}};
       },
       "unknown-pass-type", "--swap", "'blur'"},
      {"graph param",
       [](LinkOptions& o) {
         o.sets = {{"leven", "1"}};
       },
       "unknown-graph-param", "--set", "'level'"},
      {"pass",
       [](LinkOptions& o) {
         o.sets = {{"filtr.strength", "1"}};
       },
       "no-match", "--set", "'filter'"},
      {"param",
       [](LinkOptions& o) {
         o.sets = {{"filter.strenght", "1"}};
       },
       "unknown-param", "--set", "'strength'"},
      {"range",
       [](LinkOptions& o) {
         o.sets = {{"filter.strength", "11"}};
       },
       "out-of-range", "--set", ""},
      {"graph range",
       [](LinkOptions& o) {
         o.sets = {{"level", "-0.5"}};
       },
       "out-of-range", "--set", ""},
      {"type",
       [](LinkOptions& o) {
         o.sets = {{"filter.strength", "much"}};
       },
       "wrong-type", "--set", ""},
      {"graph type",
       [](LinkOptions& o) {
         o.sets = {{"level", "much"}};
       },
       "wrong-type", "--set", ""},
      {"not a number",
       [](LinkOptions& o) {
         o.sets = {{"filter.strength", "nan"}};
       },
       "out-of-range", "--set", ""},
      {"choice",
       [](LinkOptions& o) {
         o.sets = {{"s.mode", "twoo"}};
       },
       "unknown-choice", "--set", "'two'"},
      {"capture", [](LinkOptions& o) { o.captures = {"filter.b"}; }, "no-match", "--dump", "'filter.a'"},
      {"size",
       [](LinkOptions& o) {
         o.view = {0, 16385};
       },
       "out-of-range", "--size", ""},
  };
  const std::string text = file(
      R"("s": {"type": "source", "params": {"level": "$level"}}, "filter": {"type": "filter", "in": {"x": "s.a"}})",
      R"("o": "filter.a")", R"("params": {"level": 0.5}, "variants": {"fast": {"disable": ["filter"]}},)");
  ASSERT_TRUE(link_text(text).graph);
  for (const OptionCase& test : cases) {
    LinkOptions options;
    test.spoil(options);
    const toy::Result result = link_text(text, options);
    ASSERT_EQ(result.codes(), Names{test.code}) << test.what << "\n" << result.text();
    EXPECT_EQ(result.diagnostics.all()[0].where, (SourceLocation{test.place, 0, 0})) << test.what;
    EXPECT_NE(result.diagnostics.all()[0].hint.find(test.hint), std::string::npos) << result.text();
    EXPECT_FALSE(result.graph);
  }
}

}  // namespace
}  // namespace lightloom
