// How graphs say in which format values are stored (framework/graph/link_formats.cpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "framework/graph/plan.hpp"
#include "tests/graph/real_passes.hpp"
#include "tests/support/toy_graphs.hpp"

namespace lightloom {
namespace {

using toy::file;
using toy::graph_of;
using toy::link_text;

const std::string kSource = R"("s": {"type": "source"})";
const std::string kOutput = R"("o": "s.a")";

/// Name of the format of a value of the graph.
std::string format_of(const Graph& graph, const std::string& name) {
  const auto found = std::find_if(graph.values.begin(), graph.values.end(),
                                  [&](const Value& value) { return value_name(value) == name; });
  return found == graph.values.end() ? "none" : std::string(format_info(found->desc.format).name);
}

LinkOptions stored(std::vector<std::pair<std::string, std::string>> formats) {
  LinkOptions options;
  options.formats = std::move(formats);
  return options;
}

/// The source with an output that no graph may store otherwise.
PassRegistry with_exact_source() {
  PassRegistry types;
  for (const std::string& name : toy::registry().names()) {
    PassType type = *toy::registry().find(name);
    if (name == "small") type.ports.front().exact_format = "it counts";
    types.add(type);
  }
  return types;
}

TEST(Formats, ANodeAVariantAndTheCommandLineSayHowAValueIsStored) {
  const std::string plain = file(kSource, kOutput);
  EXPECT_EQ(format_of(graph_of(plain), "s.a"), "rgba16_sfloat");
  const std::string node = file(R"("s": {"type": "source", "formats": {"a": "rgba32_sfloat"}})", kOutput);
  EXPECT_EQ(format_of(graph_of(node), "s.a"), "rgba32_sfloat");
  EXPECT_EQ(format_of(graph_of(plain, stored({{"s.a", "rgba32_sfloat"}})), "s.a"), "rgba32_sfloat");
  LinkOptions options;
  options.variants = {"wide"};
  const std::string variant = file(kSource, kOutput, R"("variants": {"wide": {"formats": {"s.*": "rgba32_sfloat"}}},)");
  EXPECT_EQ(format_of(graph_of(variant), "s.a"), "rgba16_sfloat");
  EXPECT_EQ(format_of(graph_of(variant, options), "s.a"), "rgba32_sfloat");
}

TEST(Formats, LaterWishesWin) {
  LinkOptions options = stored({{"*", "rgba32_sfloat"}, {"s.a", "rgba16_sfloat"}});
  const std::string node = file(R"("s": {"type": "source", "formats": {"a": "rgba32_sfloat"}})", kOutput);
  EXPECT_EQ(format_of(graph_of(node, options), "s.a"), "rgba16_sfloat");
  std::reverse(options.formats.begin(), options.formats.end());
  EXPECT_EQ(format_of(graph_of(node, options), "s.a"), "rgba32_sfloat");
}

TEST(Formats, ABundleIsStoredSoAsFarAsItCan) {
  const std::string text =
      file(R"("r": {"type": "raster"}, "k": {"type": "pick", "in": {"p": "r.p"}})", R"("o": "k.a")");
  for (const char* values : {"r.p", "r.p.u", "r.*", "*"}) {
    const Graph graph = graph_of(text, stored({{values, "rgba32_sfloat"}}));
    EXPECT_EQ(format_of(graph, "r.p.u"), "rgba32_sfloat") << values;
    EXPECT_EQ(format_of(graph, "r.p.v"), "r32_uint") << values;
  }
}

TEST(Formats, WhatCannotBeStoredSoIsRefused) {
  const std::string text =
      file(R"("r": {"type": "raster"}, "k": {"type": "pick", "in": {"p": "r.p"}})", R"("o": "k.a")");
  const std::pair<const char*, const char*> wishes[] = {{"r.p.u", "r32_sfloat"},   {"r.p.u", "rgba8_unorm"},
                                                        {"r.p.u", "rgba32_uint"},  {"r.p.v", "r32_sfloat"},
                                                        {"r.depth", "r32_sfloat"}, {"r.p", "rg32_sfloat"}};
  for (const auto& [values, format] : wishes)
    EXPECT_EQ(link_text(text, stored({{values, format}})).codes(), std::vector<std::string>{"format-mismatch"})
        << values << " " << format;
  EXPECT_EQ(link_text(text, stored({{"r.q", "rgba32_sfloat"}})).codes(), std::vector<std::string>{"no-match"});
  EXPECT_EQ(link_text(text, stored({{"r.p.u", "rgba64"}})).codes(), std::vector<std::string>{"unknown-format"});
  EXPECT_EQ(link_text(text, stored({{"r.depth", "d32_sfloat"}})).codes(), std::vector<std::string>{"unknown-format"});
}

TEST(Formats, APortThatNeedsItsWidthKeepsItAndSaysWhy) {
  const PassRegistry types = with_exact_source();
  const std::string text = file(kSource + R"(, "t": {"type": "small"})", R"("o": "s.a", "p": "t.a")");
  const toy::Result refused = link_text(text, stored({{"t.a", "rgba32_sfloat"}}), types);
  EXPECT_EQ(refused.codes(), std::vector<std::string>{"exact-format"});
  EXPECT_NE(refused.text().find("it counts"), std::string::npos);
  EXPECT_EQ(format_of(graph_of(text, stored({{"t.a", "rgba16_sfloat"}}), types), "t.a"), "rgba16_sfloat");
  // Among others it is left as it is, with a note.
  const Graph graph = graph_of(text, stored({{"*", "rgba32_sfloat"}}), types);
  EXPECT_EQ(format_of(graph, "s.a"), "rgba32_sfloat");
  EXPECT_EQ(format_of(graph, "t.a"), "rgba16_sfloat");
  ASSERT_EQ(graph.notes.size(), 1u);
  EXPECT_NE(graph.notes.front().find("t.a stays rgba16_sfloat: it counts"), std::string::npos);
}

TEST(Formats, AccumulateRefusesHalvesForItsSums) {
  const PassRegistry& types = real_passes();
  const std::string text = R"({"lightloom": 1, "passes": {
      "gather": {"type": "gather"},
      "mean": {"type": "accumulate", "in": {"radiance": "gather.surface.emission", "past": "mean.accumulation@1"}}},
      "outputs": {"o": "mean.radiance"}})";
  for (const char* values : {"mean.accumulation", "mean.accumulation.sum", "mean.accumulation.spread_error"})
    EXPECT_EQ(link_text(text, stored({{values, "rgba16_sfloat"}}), types).codes(),
              std::vector<std::string>{"exact-format"})
        << values;
  const Graph graph = graph_of(text, stored({{"mean.*", "rgba16_sfloat"}}), types);
  EXPECT_EQ(format_of(graph, "mean.radiance"), "rgba16_sfloat");
  EXPECT_EQ(format_of(graph, "mean.accumulation.sum"), "rgba32_sfloat");
}

TEST(Formats, TheStandInOfADisabledPassHasTheFormatToo) {
  LinkOptions options = stored({{"b.a", "rgba32_sfloat"}});
  options.disables = {"b"};
  const Graph graph =
      graph_of(file(kSource + R"(, "b": {"type": "black", "in": {"x": "s.a"}})", R"("o": "b.a")"), options);
  EXPECT_EQ(format_of(graph, "b.a"), "rgba32_sfloat");
}

TEST(Formats, ASwapThatDropsTheOutputDropsItsFormatWithANote) {
  LinkOptions options;
  options.swaps = {{"r", "source"}};
  const Graph graph = graph_of(
      file(R"("r": {"type": "raster", "formats": {"p.u": "rgba32_sfloat"}}, "s": {"type": "source"})", kOutput),
      options);
  ASSERT_FALSE(graph.notes.empty());
  EXPECT_NE(graph.notes.front().find("without output 'p.u'"), std::string::npos);
}

TEST(Formats, ThePlanHashKnowsThem) {
  const std::string text = file(kSource, kOutput);
  const uint64_t plain = plan_hash(toy::plan_of(text));
  EXPECT_NE(plan_hash(toy::plan_of(text, stored({{"s.a", "rgba32_sfloat"}}))), plain);
  EXPECT_EQ(plan_hash(toy::plan_of(text, stored({{"s.a", "rgba16_sfloat"}}))), plain);
}

TEST(Formats, EveryFormatIsItsOwnChoiceAndChoicesAreMutual) {
  for (const std::string& name : format_names()) {
    const Format format = find_format(name).value();
    const std::vector<Format> choices = storage_choices(format);
    EXPECT_EQ(std::count(choices.begin(), choices.end(), format), 1) << name;
    for (const Format choice : choices) {
      EXPECT_EQ(storage_choices(choice), choices) << name;
      EXPECT_EQ(format_info(choice).channels, format_info(format).channels) << name;
      EXPECT_EQ(format_info(choice).numeric, format_info(format).numeric) << name;
    }
  }
  EXPECT_EQ(find_format("d32_sfloat"), std::nullopt);
  EXPECT_EQ(largest_number(Format::rg16_sfloat), 65504.0f);
  EXPECT_EQ(largest_number(Format::r32_sfloat), std::numeric_limits<float>::max());
  EXPECT_EQ(channel_bits(Format::rgba16_unorm), 16u);
}

}  // namespace
}  // namespace lightloom
