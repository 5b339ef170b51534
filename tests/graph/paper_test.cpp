#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>

#include "framework/base/file.hpp"
#include "framework/base/text.hpp"
#include "framework/graph/verify.hpp"
#include "tests/graph/real_passes.hpp"
#include "tests/support/source_dir.hpp"
#include "tests/support/toy_graphs.hpp"

namespace lightloom {
namespace {

std::string paper_text() {
  return read_text_file(source_dir() / "graphs" / "paper.json");
}

Graph paper(const LinkOptions& options = {}, bool dynamic = true) {
  return toy::graph_of(paper_text(), options, real_passes(), toy::environment(dynamic));
}

std::vector<std::string> names_of(const std::vector<PassRemark>& remarks) {
  std::vector<std::string> names;
  for (const PassRemark& remark : remarks) names.push_back(remark.pass);
  return names;
}

TEST(PaperGraph, RunsEveryStageInADynamicScene) {
  const Plan plan = compile(paper());
  ASSERT_EQ(plan.once.size(), 1U);
  EXPECT_EQ(plan.graph.passes[plan.once.front().pass].name, "voxelize_static");
  EXPECT_EQ(plan.steps.size(), 14U);
  EXPECT_TRUE(plan.graph.culled.empty());
  EXPECT_EQ(verify(plan).violations, std::vector<std::string>{});
}

TEST(PaperGraph, AStaticSceneNeedsNoDynamicVoxels) {
  const Graph graph = paper({}, false);
  EXPECT_EQ(names_of(graph.bypassed), (std::vector<std::string>{"voxelize_dynamic", "merge"}));
  EXPECT_EQ(toy::source(graph, "distance", "voxels", "albedo"), "voxelize_static.voxels.albedo");
  EXPECT_EQ(toy::source(graph, "trace", "voxels", "material"), "voxelize_static.voxels.material");
}

TEST(PaperGraph, EveryVariantAndEveryDenoiserAloneLinksWithoutHazard) {
  const std::vector<std::vector<std::string>> disabled = {{"denoise_*"},     {"denoise_tangent"}, {"denoise_bitangent"},
                                                          {"denoise_box_x"}, {"denoise_box_y"},   {"temporal"},
                                                          {"modulate"},      {"trace_surface"}};
  for (const bool dynamic : {false, true}) {
    for (const auto& globs : disabled) {
      LinkOptions options;
      options.disables = globs;
      options.captures = {"*"};
      EXPECT_EQ(verify(compile(paper(options, dynamic)), {}, 1).violations, std::vector<std::string>{}) << globs[0];
    }
    for (const char* variant : {"no_denoise", "no_temporal", "raw", "paths15"}) {
      LinkOptions options;
      options.variants = {variant};
      EXPECT_EQ(verify(compile(paper(options, dynamic)), {}, 1).violations, std::vector<std::string>{}) << variant;
    }
  }
}

TEST(PaperGraph, CapturingEverythingLeavesTheStepsAsTheyAre) {
  LinkOptions options;
  options.captures = {"*"};
  const Plan plain = compile(paper());
  Plan watched = compile(paper(options));
  EXPECT_EQ(toy::order(plain), toy::order(watched));
  for (std::size_t i = 0; i < plain.graph.values.size(); ++i) {
    EXPECT_TRUE(watched.graph.values[i].read);
    watched.graph.values[i].read = plain.graph.values[i].read;  // by nobody else
  }
  EXPECT_EQ(plain.graph.values, watched.graph.values);
  for (std::size_t i = 0; i < plain.graph.passes.size(); ++i) {
    EXPECT_EQ(plain.graph.passes[i].inputs, watched.graph.passes[i].inputs);
    EXPECT_EQ(plain.graph.passes[i].outputs, watched.graph.passes[i].outputs);
  }
  EXPECT_EQ(watched.graph.captures.size(), watched.graph.values.size());
}

TEST(PaperGraph, TheVariantOfNoDenoisersIsTheOptionOfNoDenoisers) {
  LinkOptions variant;
  variant.variants = {"no_denoise"};
  LinkOptions option;
  option.disables = {"denoise_*"};
  EXPECT_EQ(plan_hash(compile(paper(variant))), plan_hash(compile(paper(option))));
}

TEST(PaperGraph, ParamsReachTheirPasses) {
  LinkOptions options;
  options.sets = {{"resolution", "64"}, {"exposure", "2"}, {"denoise_*.normal_threshold", "0.5"}};
  const Graph graph = paper(options);
  EXPECT_EQ(toy::pass(graph, "voxelize_static").params.integer("resolution"), 64);
  EXPECT_EQ(toy::pass(graph, "tonemap").params.real("exposure"), 2.0);
  EXPECT_EQ(toy::pass(graph, "denoise_box_y").params.real("normal_threshold"), 0.5);
  EXPECT_EQ(graph.values[toy::pass(graph, "voxelize_static").outputs[0].value].desc.extent, (Extent3{64, 33, 64}));
}

/// Changes a text at a few random places: bytes, pieces taken out, doubled or moved, words of the format put in.
std::string mutate(std::string text, std::mt19937& random) {
  static const std::vector<std::string> words = {"\"",
                                                 "{",
                                                 "}",
                                                 "[",
                                                 "]",
                                                 ",",
                                                 ":",
                                                 "null",
                                                 "true",
                                                 "-1",
                                                 "1e999",
                                                 "0.5",
                                                 "\"a\"",
                                                 "\"$x\"",
                                                 "@1",
                                                 "@1..9",
                                                 "@99",
                                                 ".",
                                                 "\\",
                                                 "\n",
                                                 "$",
                                                 "*",
                                                 "\"gather.surface\"",
                                                 "\"trace.radiance@1\"",
                                                 "\"in\"",
                                                 "\"type\"",
                                                 "\xff",
                                                 "\xE2\x82",
                                                 "999999999999999999999"};
  const auto place = [&] { return text.empty() ? 0 : random() % (text.size() + 1); };
  for (auto n = 1 + random() % 3; n > 0; --n) {
    const std::size_t at = place();
    const std::size_t length = std::min<std::size_t>(random() % 40, text.size() - at);
    switch (random() % 6) {
      case 0:
        text.erase(at, length);
        break;
      case 1:
        text.insert(place(), text.substr(at, length));
        break;
      case 2:
        text.insert(at, words[random() % words.size()]);
        break;
      case 3:
        if (at < text.size()) text[at] = static_cast<char>(random() % 256);
        break;
      case 4:
        text.replace(at, length, words[random() % words.size()]);
        break;
      default:
        if (random() % 8 == 0) text.resize(at);
    }
  }
  return text;
}

/// Replaces the value of one random string by another of the file's strings, so that the text stays JSON.
std::string mutate_string(std::string text, std::mt19937& random) {
  std::vector<std::pair<std::size_t, std::size_t>> strings;
  for (std::size_t open = text.find('"'); open != std::string::npos;) {
    const std::size_t close = text.find('"', open + 1);
    strings.emplace_back(open, close - open + 1);
    open = text.find('"', close + 1);
  }
  const auto from = strings[random() % strings.size()];
  const auto to = strings[random() % strings.size()];
  std::string piece = text.substr(from.first, from.second);
  if (random() % 4 == 0) piece.insert(piece.size() - 1, random() % 2 == 0 ? "@1" : "@2..3");
  return text.replace(to.first, to.second, piece);
}

TEST(GraphFuzz, MutantsGiveDiagnosticsOrAPlanThatHolds) {
  std::mt19937 random(20);
  const std::string text = paper_text();
  int valid = 0;
  int beyond_syntax = 0;
  for (int i = 0; i < 6000; ++i) {
    std::string mutant = text;
    if (i % 2 == 0) {
      mutant = mutate(mutant, random);
    } else {
      for (auto n = 1 + random() % 2; n > 0; --n) mutant = mutate_string(mutant, random);
    }
    LinkOptions options;
    if (i % 3 == 0) options.disables = {i % 2 == 0 ? "denoise_*" : "*"};
    if (i % 5 == 0) options.captures = {"*"};
    if (i % 7 == 0) options.swaps = {{"t*", "tonemap"}};
    toy::Result result;
    ASSERT_NO_THROW(result = toy::link_text(mutant, options, real_passes(), toy::environment(i % 4 == 0))) << mutant;
    ASSERT_EQ(result.graph.has_value(), !result.diagnostics.has_errors()) << mutant;
    for (const Diagnostic& diagnostic : result.diagnostics.all())
      ASSERT_TRUE(!diagnostic.where.file.empty() && !diagnostic.message.empty() && !diagnostic.code.empty()) << mutant;
    const bool syntax = !result.diagnostics.all().empty() && result.diagnostics.all()[0].code == "json-syntax";
    beyond_syntax += syntax ? 0 : 1;
    if (!result.graph) continue;
    ++valid;
    const Plan plan = compile(*result.graph);
    ASSERT_FALSE(print_plan(plan).empty());
    if (i % 10 != 0) continue;
    ASSERT_EQ(verify(plan, {}, 1).violations, std::vector<std::string>{}) << mutant;
  }
  EXPECT_GT(valid, 150);
  EXPECT_GT(beyond_syntax, 2000);
}

}  // namespace
}  // namespace lightloom
