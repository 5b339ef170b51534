#include "framework/graph/hoist.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "tests/support/random_graph.hpp"
#include "tests/support/toy_graphs.hpp"

namespace lightloom {
namespace {

using toy::file;
using toy::plan_of;

std::set<std::string> hoisted(const Graph& graph) {
  std::set<std::string> names;
  for (const GraphPass& pass : graph.passes)
    if (!pass.once.empty()) names.insert(pass.name);
  return names;
}

std::set<std::string> hoisted(const std::string& passes, const std::string& output, bool dynamic = true,
                              const LinkOptions& options = {}) {
  return hoisted(
      toy::graph_of(file(passes, "\"o\": \"" + output + "\""), options, toy::registry(), toy::environment(dynamic)));
}

using Names = std::set<std::string>;
constexpr const char* kStillChain =
    R"("k": {"type": "still"}, "f": {"type": "filter", "in": {"x": "k.a"}}, "g": {"type": "filter", "in": {"x": "f.a"}})";

TEST(Hoist, AChainOfWhatNeverChanges) {
  EXPECT_EQ(hoisted(kStillChain, "g.a"), (Names{"k", "f", "g"}));
}

TEST(Hoist, OneInputThatChangesIsEnough) {
  const std::string passes = std::string(kStillChain) + R"(, "s": {"type": "source"},
      "m": {"type": "mix", "in": {"x": "g.a", "y": "s.a"}}, "n": {"type": "filter", "in": {"x": "m.a"}})";
  EXPECT_EQ(hoisted(passes, "n.a"), (Names{"k", "f", "g"}));
}

TEST(Hoist, AHistoryIsDifferentInTheFirstFrame) {
  EXPECT_EQ(hoisted(R"("k": {"type": "still"}, "f": {"type": "filter", "in": {"x": "k.a@1"}})", "f.a"), Names{});
  EXPECT_EQ(
      hoisted(R"("k": {"type": "still"}, "c": {"type": "accumulate", "in": {"x": "k.a", "last": "c.a@1"}})", "c.a"),
      Names{"k"});
}

TEST(Hoist, ASideEffectHappensInEveryFrame) {
  EXPECT_EQ(hoisted(R"("k": {"type": "still"}, "e": {"type": "sink", "in": {"x": "k.a"}})", "k.a"), Names{"k"});
}

TEST(Hoist, AConstantNeverChanges) {
  LinkOptions options;
  options.disables = {"b"};
  EXPECT_EQ(hoisted(R"("s": {"type": "source"}, "b": {"type": "black", "in": {"x": "s.a"}},
                       "f": {"type": "filter", "in": {"x": "b.a@1"}})",
                    "f.a", true, options),
            Names{"f"});
}

TEST(Hoist, WhatAPassReadsDependsOnItsParams) {
  EXPECT_EQ(hoisted(R"("b": {"type": "body"}, "f": {"type": "filter", "in": {"x": "b.a"}})", "f.a"), (Names{"b", "f"}));
  const std::string dynamic = R"("b": {"type": "body", "params": {"geometry": "dynamic"}})";
  EXPECT_EQ(hoisted(dynamic, "b.a"), Names{});
  EXPECT_EQ(hoisted(dynamic, "b.a", false), Names{"b"}) << "a scene in which nothing moves";
}

TEST(Hoist, CanBeSwitchedOff) {
  LinkOptions options;
  options.hoist = false;
  EXPECT_EQ(hoisted(kStillChain, "g.a", true, options), Names{});
  const std::string text = file(kStillChain, R"("o": "g.a")");
  EXPECT_NE(plan_hash(plan_of(text)), plan_hash(plan_of(text, options)));
}

TEST(Hoist, WhatIsWrittenOnceKeepsNothing) {
  const auto persistent = [](const std::string& source) {
    const Graph graph = toy::graph_of(
        file("\"s\": {\"type\": \"" + source + R"("}, "p": {"type": "patch", "in": {"x": "s.a"}})", R"("o": "p.a")"));
    return std::count_if(graph.values.begin(), graph.values.end(), [](const Value& v) { return v.persistent; });
  };
  EXPECT_EQ(persistent("still"), 0);
  EXPECT_EQ(persistent("source"), 2);
}

TEST(Hoist, AHistoryOfAPersistentValueKeepsNothing) {
  const Graph graph = toy::graph_of(file(R"("s": {"type": "source"}, "p": {"type": "patch", "in": {"x": "s.a"}},
      "f": {"type": "filter", "in": {"x": "p.a", "y": "p.a@1"}})",
                                         R"("o": "f.a")"));
  for (const Value& value : graph.values) EXPECT_EQ(value.persistent, value.port == "memo") << value_name(value);
}

TEST(Hoist, TheTextSaysWhatRunsOnceAndWhy) {
  const Plan plan = plan_of(file(R"("k": {"type": "still"}, "s": {"type": "source"},
      "p": {"type": "patch", "in": {"x": "s.a"}},
      "f": {"type": "filter", "in": {"x": "k.a"}}, "m": {"type": "mix", "in": {"x": "f.a", "y": "p.a"}})",
                                 R"("o": "m.a")"));
  const std::string text = print_plan(plan);
  const auto at = [&](const char* piece) {
    EXPECT_NE(text.find(piece), std::string::npos) << piece << "\n" << text;
    return text.find(piece);
  };
  const std::size_t prologue = at("\nprologue\n  clear p.a to (0, 0, 0, 0), kept from frame to frame");
  const std::size_t once = at("\nonce, ");
  const std::size_t frame = at("\nframe\n");
  EXPECT_LT(prologue, once);
  EXPECT_LT(once, frame);
  for (const char* piece : {"1. k (still)\n       what it reads never changes: static geometry, materials",
                            "2. f (filter) strength=1.0\n       what it reads never changes: k.a"}) {
    EXPECT_GT(at(piece), once);
    EXPECT_LT(at(piece), frame);
  }
  EXPECT_GT(at("3. s (source)"), frame);
  EXPECT_GT(at("out a: rgba16_sfloat 64x48, kept from frame to frame"), frame);
  at("5 passes, 2 of them once");
}

/// Executes a plan with symbols in the place of images: what a pass writes is a text of all that it depends on.
class SymbolicRun {
 public:
  explicit SymbolicRun(const Plan& plan) : plan_(plan) {}

  /// What the observations of each frame see, in order of value and age.
  std::vector<std::map<std::pair<std::string, uint32_t>, std::string>> run(int frames) {
    std::vector<std::map<std::pair<std::string, uint32_t>, std::string>> seen;
    for (frame_ = 0; frame_ < frames; ++frame_) {
      seen.emplace_back();
      if (frame_ == 0) steps(plan_.once, seen.back());
      observations(plan_.opening_observations, seen.back());
      steps(plan_.steps, seen.back());
    }
    return seen;
  }

 private:
  using Seen = std::map<std::pair<std::string, uint32_t>, std::string>;

  void steps(const std::vector<PlanStep>& list, Seen& seen) {
    for (const PlanStep& step : list) {
      const GraphPass& pass = plan_.graph.passes[step.pass];
      std::string symbol = pass.name + "(";
      for (const FrameState part :
           {FrameState::camera, FrameState::time, FrameState::seed, FrameState::lights, FrameState::dynamic_geometry})
        if (contains(pass.type->reads_of(pass.params), part)) symbol += "frame " + std::to_string(frame_) + ",";
      for (const Use& use : pass.inputs)
        for (uint32_t age = use.first_age; age <= use.last_age; ++age) symbol += at(use.value, age) + ",";
      // Symbols grow with the square of the frames; their hash stands for them.
      symbol = std::to_string(std::hash<std::string>{}(symbol));
      for (const auto* uses : {&pass.outputs, &pass.scratch})
        for (const Use& use : *uses)
          memory_[{use.value, layer(use.value, 0)}] = symbol + "." + use.port + "." + use.part;
      observations(step.observations, seen);
    }
  }

  void observations(const std::vector<Observation>& list, Seen& seen) {
    for (const Observation& observation : list)
      seen[{value_name(plan_.graph.values[observation.value]), observation.age}] =
          at(observation.value, observation.age);
  }

  uint32_t layer(ValueId value, uint32_t age) const {
    const uint32_t ring = ring_layers(plan_.graph.values[value]);
    return (static_cast<uint32_t>(frame_) + 2 * ring - age) % ring;
  }

  std::string at(ValueId value, uint32_t age) const {
    if (plan_.graph.values[value].constant) return "constant";
    const auto found = memory_.find({value, layer(value, age)});
    return found == memory_.end() ? "cleared" : found->second;
  }

  const Plan& plan_;
  int frame_ = 0;
  std::map<std::pair<ValueId, uint32_t>, std::string> memory_;
};

TEST(Hoist, RandomGraphsSeeTheSameWithAndWithout) {
  std::size_t once = 0;
  std::size_t each = 0;
  for (uint32_t seed = 0; seed < 200; ++seed) {
    LinkOptions options;
    if (seed % 4 < 2) options.captures = {"*"};
    const std::string text = toy::random_graph(seed, 3 + static_cast<int>(seed % 14));
    const Plan with = plan_of(text, options);
    options.hoist = false;
    const Plan without = plan_of(text, options);
    EXPECT_TRUE(without.once.empty());
    EXPECT_EQ(SymbolicRun(with).run(7), SymbolicRun(without).run(7)) << "seed " << seed << "\n" << print_plan(with);
    once += with.once.size();
    each += with.steps.size();
  }
  EXPECT_GT(once, 80U);  // 95 to 110 by the compiler, which decides the order in which random numbers are drawn
  EXPECT_GT(each, 200U);
}

/// As many as can be: a pass stays in the frame only where its symbol differs between two frames, a history of it is
/// kept, it has a side effect, or it depends on one that stays.
TEST(Hoist, RandomGraphsHoistAllThatCanBe) {
  for (uint32_t seed = 0; seed < 200; ++seed) {
    LinkOptions options;
    options.captures = {"*"};
    const Plan plan = plan_of(toy::random_graph(seed, 3 + static_cast<int>(seed % 14)), options);
    const auto seen = SymbolicRun(plan).run(7);
    const Graph& graph = plan.graph;
    std::set<ValueId> in_frame;
    for (const PlanStep& step : plan.steps) {
      const GraphPass& pass = graph.passes[step.pass];
      bool justified = pass.type->side_effect;
      for (const Use& use : pass.inputs) justified = justified || in_frame.contains(use.value);
      for (const Use& use : pass.outputs) {
        in_frame.insert(use.value);
        justified = justified || graph.values[use.value].history > 0;
        for (const auto& frame : seen)
          justified = justified || frame.at({value_name(graph.values[use.value]), 0}) !=
                                       seen[0].at({value_name(graph.values[use.value]), 0});
      }
      EXPECT_TRUE(justified) << "seed " << seed << ", " << pass.name << "\n" << print_plan(plan);
    }
  }
}

}  // namespace
}  // namespace lightloom
