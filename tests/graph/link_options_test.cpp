#include <gtest/gtest.h>

#include <algorithm>

#include "framework/graph/link.hpp"
#include "tests/graph/toy_graphs.hpp"

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
