#include <gtest/gtest.h>

#include "framework/base/file.hpp"
#include "framework/graph/graph_spec.hpp"
#include "tests/support/source_dir.hpp"
#include "tests/support/toy_graphs.hpp"

namespace lightloom {
namespace {

TEST(ParseEdge, Forms) {
  const EdgeParse plain = parse_edge("trace.radiance");
  ASSERT_TRUE(plain.edge);
  EXPECT_EQ(plain.edge->pass, "trace");
  EXPECT_EQ(plain.edge->port, "radiance");
  EXPECT_EQ(plain.edge->part, "");
  EXPECT_EQ(plain.edge->first_age, 0U);
  const EdgeParse range = parse_edge("gather.surface.normal@2..15");
  ASSERT_TRUE(range.edge);
  EXPECT_EQ(range.edge->part, "normal");
  EXPECT_EQ(range.edge->first_age, 2U);
  EXPECT_EQ(range.edge->last_age, 15U);
  const EdgeParse single = parse_edge("a.b@3");
  ASSERT_TRUE(single.edge);
  EXPECT_EQ(single.edge->first_age, 3U);
  EXPECT_EQ(single.edge->last_age, 3U);
}

TEST(ParseEdge, RefusesEverythingElse) {
  for (const char* text : {"",       "a",         "a.",        ".b",      "a.b.c.d",         "A.b",     "a.b ",
                           "a b.c",  "a.b@",      "a.b@0",     "a.b@-1",  "a.b@1..",         "a.b@..2", "a.b@3..2",
                           "a.b@16", "a.b@1..16", "a.b@1...3", "a.b@1@2", "a.b@99999999999", "a.b@1.c", "@1",
                           "a.b@+1"}) {
    const EdgeParse parsed = parse_edge(text);
    EXPECT_FALSE(parsed.edge) << text;
    EXPECT_FALSE(parsed.problem.empty()) << text;
  }
}

TEST(ParseGraph, KeepsEveryValueWithItsPlace) {
  const std::string text = R"({
  "lightloom": 1,
  "name": "demo",
  "view": { "width": 100, "height": 50 },
  "params": { "n": 3, "f": 0.5, "b": true, "s": "x" },
  "passes": {
    "one": { "type": "source", "params": { "level": "$f" }, "doc": "first" },
    "two": { "type": "filter", "in": { "x": "one.a@2" }, "enabled": false, "when": "scene.sun" }
  },
  "outputs": { "image": "two.a" },
  "variants": { "v": { "disable": ["t*"], "set": { "n": 4, "one.count": 7 }, "swap": { "two": "blur" } } }
})";
  Diagnostics diagnostics;
  const std::optional<GraphSpec> spec = parse_graph(text, "demo.json", diagnostics);
  ASSERT_TRUE(spec);
  EXPECT_TRUE(diagnostics.all().empty());
  EXPECT_EQ(spec->name, "demo");
  EXPECT_EQ(spec->view.width, 100U);
  EXPECT_EQ(spec->trace.height, 480U);
  ASSERT_EQ(spec->params.size(), 4U);
  EXPECT_EQ(spec->params[0].value, ParamValue(int64_t{3}));
  EXPECT_EQ(spec->params[1].value, ParamValue(0.5));
  EXPECT_EQ(spec->params[2].value, ParamValue(true));
  EXPECT_EQ(spec->params[3].value, ParamValue(std::string("x")));
  EXPECT_EQ(spec->params[1].where, (SourceLocation{"demo.json", 5, 28}));
  ASSERT_EQ(spec->passes.size(), 2U);
  const PassSpec& two = spec->passes[1];
  EXPECT_EQ(two.where, (SourceLocation{"demo.json", 8, 5}));
  EXPECT_EQ(two.type.where, (SourceLocation{"demo.json", 8, 22}));
  EXPECT_EQ(two.inputs[0].name_where, (SourceLocation{"demo.json", 8, 40}));
  EXPECT_EQ(two.inputs[0].edge.where, (SourceLocation{"demo.json", 8, 45}));
  EXPECT_EQ(two.inputs[0].edge.last_age, 2U);
  EXPECT_FALSE(two.enabled);
  EXPECT_EQ(two.when->text, "scene.sun");
  EXPECT_EQ(spec->passes[0].doc, "first");
  EXPECT_EQ(spec->outputs[0].edge.pass, "two");
  const VariantSpec& variant = spec->variants[0];
  EXPECT_EQ(variant.disable[0].where, (SourceLocation{"demo.json", 11, 36}));
  EXPECT_EQ(variant.set[1].name, "one.count");
  EXPECT_EQ(variant.swap[0].type.text, "blur");
}

TEST(ParseGraph, GoesOnBehindEveryProblemAndIntoTheLinker) {
  const toy::Result result = toy::link_text(R"({
"lightloom": 1, "nmae": "x",
"view": { "width": 0, "height": "8" },
"passes": {
  "one": { "type": "sorce" },
  "two": { "type": "filter", "in": { "x": "one" }, "params": { "strength": 99 } },
  "three": { "type": "filter", "in": { "x": "four.a" } }
},
"outputs": { "image": "two.a" }
})");
  EXPECT_EQ(result.codes(), (std::vector<std::string>{"unknown-key", "out-of-range", "wrong-type", "unknown-pass-type",
                                                      "bad-edge", "out-of-range", "unknown-pass"}))
      << result.text();
  EXPECT_FALSE(result.graph);
}

TEST(ParseGraph, ShippedGraphsHaveNoProblem) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source_dir() / "graphs")) {
    Diagnostics diagnostics;
    static_cast<void>(parse_graph(read_text_file(entry.path()), entry.path().filename().string(), diagnostics));
    for (const Diagnostic& diagnostic : diagnostics.all()) ADD_FAILURE() << format_diagnostic(diagnostic);
    ++count;
  }
  EXPECT_GT(count, 0);
}

}  // namespace
}  // namespace lightloom
