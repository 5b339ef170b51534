#include <gtest/gtest.h>

#include <algorithm>

#include "framework/graph/link.hpp"
#include "tests/support/toy_graphs.hpp"

namespace lightloom {
namespace {

using toy::file;
using toy::graph_of;
using toy::link_text;

const std::string kSource = R"("s": {"type": "source"})";

std::vector<std::string> culled(const Graph& graph) {
  std::vector<std::string> names;
  for (const PassRemark& remark : graph.culled) names.push_back(remark.pass);
  return names;
}

using Names = std::vector<std::string>;

TEST(When, SizesDiffer) {
  for (const bool negated : {false, true}) {
    const std::string text = file(kSource + R"(, "f": {"type": "filter", "in": {"x": "s.a"}, "when": ")" +
                                      (negated ? "!" : "") + R"(sizes.differ"})",
                                  R"("o": "f.a")");
    using Size = std::optional<std::pair<uint32_t, uint32_t>>;
    const auto has_filter = [&](const Size& view, const Size& trace) {
      LinkOptions options;
      options.view = view;
      options.trace = trace;
      const Graph graph = graph_of(text, options);
      return std::any_of(graph.passes.begin(), graph.passes.end(), [](const GraphPass& p) { return p.name == "f"; });
    };
    EXPECT_EQ(has_filter({{64, 48}}, {{64, 48}}), negated);
    EXPECT_EQ(has_filter({{64, 48}}, {{32, 48}}), !negated);
    EXPECT_EQ(has_filter({{64, 48}}, {{64, 24}}), !negated);
    // The file says 64x48 and 32x24.
    EXPECT_EQ(has_filter({}, {}), !negated);
    EXPECT_EQ(has_filter({}, {{64, 48}}), negated);
    EXPECT_EQ(has_filter({{32, 24}}, {}), negated);
  }
}

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

bool any_note(const Graph& graph, const std::string& text) {
  return std::any_of(graph.notes.begin(), graph.notes.end(),
                     [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

TEST(Swap, DropsParamsAndInputsOfAnotherKindWithANote) {
  const std::string text = file(kSource + R"(, "e": {"type": "source"},
           "f": {"type": "filter", "in": {"x": "s.a", "y": "e.a"}, "params": {"strength": 3}},
           "b": {"type": "blur", "in": {"x": "s.a"}, "params": {"strength": "$s", "taps": 7}})",
                                R"("o": "f.a", "p": "b.a")", R"("params": {"s": 2},)");
  LinkOptions options;
  options.swaps = {{"f", "strange"}, {"b", "strange"}};
  const Graph graph = graph_of(text, options);
  EXPECT_EQ(toy::pass(graph, "f").params.choice("strength"), "weak");
  EXPECT_EQ(toy::pass(graph, "b").params.choice("strength"), "weak");
  EXPECT_EQ(toy::pass(graph, "b").params.real("taps"), 7.0) << "an integer is a real number, too";
  EXPECT_EQ(toy::source(graph, "f", "y", "u"), "");
  EXPECT_EQ(culled(graph), Names{"e"});
  ASSERT_EQ(graph.notes.size(), 3U);
  EXPECT_TRUE(any_note(graph, "makes 'f' a 'strange', without param 'strength', which is of another kind there"));
  EXPECT_TRUE(any_note(graph, "makes 'b' a 'strange', without param 'strength', which is of another kind there"));
  EXPECT_TRUE(any_note(graph, "makes 'f' a 'strange', without input 'y', which is of another kind there"));
  options.sets = {{"f.strength", "strong"}};
  EXPECT_EQ(toy::pass(graph_of(text, options), "f").params.choice("strength"), "strong");
  options.sets = {{"f.strength", "3"}};
  EXPECT_EQ(link_text(text, options).codes(), Names{"unknown-choice"}) << "what is set for the new type must fit it";
}

TEST(Swap, DropsParamsThatTheNewTypeLacksWithANote) {
  LinkOptions options;
  options.swaps = {{"b", "filter"}};
  const std::string text =
      file(kSource + R"(, "b": {"type": "blur", "in": {"x": "s.a"}, "params": {"strength": 2, "taps": 7}})",
           R"("o": "b.a")", R"("variants": {"v": {"swap": {"b": "choosy"}, "set": {"b.reading": "both"}}},)");
  const Graph graph = graph_of(text, options);
  EXPECT_EQ(toy::pass(graph, "b").params.real("strength"), 2.0);
  ASSERT_EQ(graph.notes.size(), 1U);
  EXPECT_TRUE(any_note(graph, "without param 'taps'"));
  options.variants = {"v"};
  const Graph twice = graph_of(text, options);
  EXPECT_EQ(toy::pass(twice, "b").type->name, "filter");
  EXPECT_EQ(toy::pass(twice, "b").params.real("strength"), 2.0);
  EXPECT_TRUE(any_note(twice, "without param 'reading'"));
}

TEST(NeededWith, AnInputThatParamsDoNotNeedCountsAsUnconnected) {
  const std::string text = file(kSource + R"(, "e": {"type": "source"}, "g": {"type": "blur", "in": {"x": "e.a"}},
           "h": {"type": "small"},
           "c": {"type": "choosy", "in": {"x": "s.a", "y": "g.a"}})",
                                R"("o": "c.a")");
  const Graph graph = graph_of(text);
  EXPECT_EQ(toy::source(graph, "c", "y"), "");
  EXPECT_EQ(toy::pass(graph, "c").unconnected, Names{"y"});
  EXPECT_EQ(culled(graph), (Names{"e", "g", "h"}));
  const std::string why = "only input 'y' of 'c' leads to it, which with its params does not read that";
  EXPECT_EQ(graph.culled[0].reason, why);
  EXPECT_EQ(graph.culled[1].reason, why);
  EXPECT_EQ(graph.culled[2].reason, "no output, capture or side effect needs it");
  LinkOptions options;
  options.sets = {{"c.reading", "both"}};
  const Graph both = graph_of(text, options);
  EXPECT_EQ(toy::source(both, "c", "y"), "g.a");
  EXPECT_EQ(culled(both), Names{"h"});
  options.sets.clear();
  options.captures = {"g.a"};
  EXPECT_EQ(culled(graph_of(text, options)), Names{"h"}) << "who looks at it needs it";
}

TEST(NeededWith, ItsEdgeIsStillChecked) {
  const auto codes = [](const std::string& edge) {
    return link_text(file(kSource + R"(, "i": {"type": "ids"}, "c": {"type": "choosy", "in": {"x": "s.a", "y": ")" +
                              edge + R"("}})",
                          R"("o": "c.a")"))
        .codes();
  };
  EXPECT_EQ(codes("s.a"), Names{});
  EXPECT_EQ(codes("q.a"), Names{"unknown-pass"});
  EXPECT_EQ(codes("s.b"), Names{"unknown-port"});
  EXPECT_EQ(codes("i.a"), Names{"numeric-mismatch"});
}

TEST(NeededWith, TheHistoryOfWhatIsNotNeededIsNotKept) {
  const Graph graph =
      graph_of(file(kSource + R"(, "c": {"type": "choosy", "in": {"x": "s.a", "y": "s.a@3"}})", R"("o": "c.a")"));
  for (const Value& value : graph.values) EXPECT_EQ(value.history, 0U);
}

TEST(NeededWith, ASwapMayTakeTheNeedAway) {
  const std::string text = file(kSource + R"(, "e": {"type": "source"},
           "f": {"type": "filter", "in": {"x": "s.a", "y": "e.a"}})",
                                R"("o": "f.a")");
  LinkOptions options;
  options.swaps = {{"f", "choosy"}};
  EXPECT_EQ(culled(graph_of(text, options)), Names{"e"});
  EXPECT_EQ(culled(graph_of(text)), Names{});
}

TEST(Swap, ReportsInputsThatTheNewTypeNeeds) {
  LinkOptions options;
  options.swaps = {{"f", "mix"}};
  const toy::Result result = link_text(
      file(kSource + R"(, "f": {"type": "blur", "in": {"x": "s.a"}, "params": {"taps": 3}})", R"("o": "f.a")"),
      options);
  EXPECT_EQ(result.codes(), Names{"missing-input"}) << result.text();
}

TEST(Options, AParamOfAllPassesOfATypeIsSetAfterSwaps) {
  const std::string text = file(kSource + R"(, "f": {"type": "choosy", "in": {"x": "s.a"}},
           "g": {"type": "choosy", "in": {"x": "s.a"}}, "b": {"type": "blur", "in": {"x": "s.a"}})",
                                R"("o": "f.a", "p": "g.a", "q": "b.a")");
  LinkOptions options;
  options.type_sets = {{"--reading", "choosy", "reading", "both"}};
  options.swaps = {{"b", "choosy"}};
  const Graph graph = graph_of(text, options);
  for (const char* name : {"f", "g", "b"}) EXPECT_EQ(toy::pass(graph, name).params.choice("reading"), "both") << name;
  options.sets = {{"g.reading", "one"}};
  EXPECT_EQ(toy::pass(graph_of(text, options), "g").params.choice("reading"), "one") << "--set has the last word";
  options.sets.clear();
  options.type_sets[0].type = "shade";
  const toy::Result none = link_text(text, options);
  ASSERT_EQ(none.codes(), Names{"no-match"}) << none.text();
  EXPECT_EQ(none.diagnostics.all()[0].where, (SourceLocation{"--reading", 0, 0}));
  EXPECT_NE(none.diagnostics.all()[0].hint.find("--swap trace=shade"), std::string::npos);
  options.type_sets[0] = {"--reading", "choosy", "reading", "neither"};
  EXPECT_EQ(link_text(text, options).codes(), (Names{"unknown-choice", "unknown-choice", "unknown-choice"}));
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
      {"trace size",
       [](LinkOptions& o) {
         o.trace = {16385, 1};
       },
       "out-of-range", "--trace-size", ""},
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
