// Ports that are whole times as large as the port they are like (Port::times). The sizes are reckoned by hand: the toy
// view is 64x48 of 8 bytes a pixel, the toy grid of resolution R is R x (R / 2 + 1) x R.
#include <gtest/gtest.h>

#include <algorithm>

#include "framework/graph/share_memory.hpp"
#include "tests/graph/memory_needs.hpp"
#include "tests/support/toy_graphs.hpp"

namespace lightloom {
namespace {

using toy::file;

PassType named(const std::string& like, const std::string& name) {
  PassType type = *toy::registry().find(like);
  type.name = name;
  return type;
}

/// The toy passes and these; inputs -> outputs:
///   grow (x) -> a [x times 2x3], bypass constant; scratch tmp [x times 1x5]
///   maybe (x?) -> a [x times 2x3]
///   stack (v) -> v [v times 1x2x2]
///   match (x, y [x times 2x3]) -> a [x]
///   match_volumes (x, y [x times 1x2x2]) -> a [x]
PassRegistry types() {
  PassRegistry types = toy::registry();
  PassType grow = named("black", "grow");
  grow.ports[1].times = {2, 3, 1};
  Port scratch = grow.ports[1];
  scratch.name = "tmp";
  scratch.direction = Direction::scratch;
  scratch.bypass.reset();
  scratch.times = {1, 5, 1};
  grow.ports.push_back(scratch);
  types.add(grow);
  PassType maybe = named("black", "maybe");
  maybe.ports[0].optional = true;
  maybe.ports[1].times = {2, 3, 1};
  types.add(maybe);
  PassType stack = named("carve", "stack");
  stack.ports[1].times = {1, 2, 2};
  stack.ports[1].bypass.reset();
  types.add(stack);
  PassType match = named("accumulate", "match");
  match.ports[1].name = "y";
  match.ports[1].times = {2, 3, 1};
  types.add(match);
  PassType volumes = match;
  volumes.name = "match_volumes";
  for (Port& port : volumes.ports) port.dimension = Dimension::d3;
  volumes.ports[1].times = {1, 2, 2};
  types.add(volumes);
  return types;
}

std::string extent(const Graph& graph, const std::string& name) {
  const auto found = std::find_if(graph.values.begin(), graph.values.end(),
                                  [&](const Value& value) { return value_name(value) == name; });
  return found == graph.values.end() ? "none" : to_string(found->desc.extent);
}

const std::string kSource = R"("s": {"type": "source"},
)";
const std::string kVolume = R"("v": {"type": "volume", "params": {"resolution": 16}},
)";

TEST(Times, EachAxisIsMultiplied) {
  const std::string text = file(kSource + kVolume + R"("g": {"type": "grow", "in": {"x": "s.a"}},
      "k": {"type": "stack", "in": {"v": "v.v"}})",
                                R"("o": "g.a", "w": "k.v")");
  const Graph graph = toy::graph_of(text, {}, types());
  EXPECT_EQ(extent(graph, "g.a"), "128x144");
  EXPECT_EQ(extent(graph, "g.tmp"), "64x240");
  EXPECT_EQ(extent(graph, "v.v"), "16x9x16");
  EXPECT_EQ(extent(graph, "k.v"), "16x18x32");
}

TEST(Times, WhatIsLikeSomethingLargerIsMultipliedAgain) {
  const std::string text = file(kSource + R"("g": {"type": "grow", "in": {"x": "s.a"}},
      "b": {"type": "blur", "in": {"x": "g.a"}}, "h": {"type": "grow", "in": {"x": "b.a"}})",
                                R"("o": "h.a")");
  const Graph graph = toy::graph_of(text, {}, types());
  EXPECT_EQ(extent(graph, "b.a"), "128x144");
  EXPECT_EQ(extent(graph, "h.a"), "256x432");
  EXPECT_EQ(extent(graph, "h.tmp"), "128x720");
}

TEST(Times, WithoutTheOptionalModelTheViewIsMultiplied) {
  const Graph graph = toy::graph_of(file(R"("m": {"type": "maybe"})", R"("o": "m.a")"), {}, types());
  EXPECT_EQ(extent(graph, "m.a"), "128x144");
}

TEST(Times, TheConstantOfADisabledPassIsAsLarge) {
  LinkOptions options;
  options.disables = {"g"};
  const Graph graph = toy::graph_of(file(kSource + R"("g": {"type": "grow", "in": {"x": "s.a"}},
      "b": {"type": "blur", "in": {"x": "g.a"}})",
                                         R"("o": "b.a")"),
                                    options, types());
  EXPECT_EQ(extent(graph, "g.a"), "128x144");
  EXPECT_EQ(extent(graph, "b.a"), "128x144");
}

TEST(Times, InputsOfThatSizeAreTaken) {
  const std::string text = file(kSource + kVolume + R"("g": {"type": "grow", "in": {"x": "s.a"}},
      "k": {"type": "stack", "in": {"v": "v.v"}}, "m": {"type": "match", "in": {"x": "s.a", "y": "g.a"}},
      "n": {"type": "match_volumes", "in": {"x": "v.v", "y": "k.v"}})",
                                R"("o": "m.a", "w": "n.a")");
  const Graph graph = toy::graph_of(text, {}, types());
  EXPECT_EQ(extent(graph, "m.a"), "64x48");
  EXPECT_EQ(extent(graph, "n.a"), "16x9x16");
}

/// "line:column" of the first `part` in the text, which must have no tabs and no letters beyond ASCII.
std::string place_of(const std::string& part, const std::string& text) {
  const size_t at = text.find(part);
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(at);
  const auto line = 1 + std::count(text.begin(), end, '\n');
  return std::to_string(line) + ":" + std::to_string(at - text.rfind('\n', at));
}

/// The text must not link for one reason: that the input which `edge` names has another size.
void expect_mismatch(const std::string& text, const std::string& edge, const std::string& sentence) {
  const toy::Result result = toy::link_text(text, {}, types());
  ASSERT_EQ(result.codes(), std::vector<std::string>{"shape-mismatch"}) << result.text();
  const Diagnostic& mistake = result.diagnostics.all().front();
  EXPECT_EQ(mistake.message, sentence);
  EXPECT_EQ(std::to_string(mistake.where.line) + ":" + std::to_string(mistake.where.column), place_of(edge, text));
}

TEST(Times, AMismatchNamesBothSizesTheModelAndThePlace) {
  expect_mismatch(file(kSource + R"("b": {"type": "blur", "in": {"x": "s.a"}},
      "m": {"type": "match", "in": {"x": "s.a", "y": "b.a"}})",
                       R"("o": "m.a")"),
                  R"("b.a")",
                  "input 'y' of pass 'm' must have the size 128x144 (2x3 times that of input 'x', which is s.a), but "
                  "b.a has 64x48");
  expect_mismatch(file(kSource + R"("g": {"type": "grow", "in": {"x": "s.a"}},
      "m": {"type": "match", "in": {"x": "g.a", "y": "g.a@1"}})",
                       R"("o": "m.a")"),
                  R"("g.a@1")",
                  "input 'y' of pass 'm' must have the size 256x432 (2x3 times that of input 'x', which is g.a), but "
                  "g.a has 128x144");
  expect_mismatch(
      file(kVolume + R"("n": {"type": "match_volumes", "in": {"x": "v.v", "y": "v.v@1"}})", R"("o": "n.a")"),
      R"("v.v@1")",
      "input 'y' of pass 'n' must have the size 16x18x32 (1x2x2 times that of input 'x', which is v.v), "
      "but v.v has 16x9x16");
}

/// s.a is live with what is made from it, that with the copy of it, and so on; the last is an output and lies apart.
TEST(Times, SharedMemoryHasRoomForTheLargerImages) {
  const std::string text = file(kSource + R"("g": {"type": "maybe", "in": {"x": "s.a"}},
      "b": {"type": "blur", "in": {"x": "g.a"}}, "c": {"type": "blur", "in": {"x": "b.a"}},
      "d": {"type": "blur", "in": {"x": "c.a"}})",
                                R"("o": "d.a")");
  Plan plan = compile(toy::graph_of(text, {}, types()));
  constexpr uint64_t kSmall = uint64_t{64} * 48 * 8;
  constexpr uint64_t kLarge = uint64_t{128} * 144 * 8;
  const MemorySharing sharing = share_memory(plan, toy::needs_of(plan.graph));
  ASSERT_EQ(sharing.heaps.size(), 1U);
  EXPECT_EQ(sharing.heaps[0].unshared, kSmall + 3 * kLarge);
  EXPECT_EQ(sharing.heaps[0].lower_bound, 2 * kLarge);
  EXPECT_EQ(sharing.heaps[0].bytes, 2 * kLarge);
}

}  // namespace
}  // namespace lightloom
