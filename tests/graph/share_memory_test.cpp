#include "framework/graph/share_memory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "framework/base/file.hpp"
#include "framework/graph/verify.hpp"
#include "tests/graph/memory_needs.hpp"
#include "tests/graph/real_passes.hpp"
#include "tests/support/random_graph.hpp"
#include "tests/support/source_dir.hpp"
#include "tests/support/toy_graphs.hpp"

namespace lightloom {
namespace {

using toy::file;
using toy::needs_of;
using toy::plan_of;

/// What a value does in a frame, gathered without the code under test.
struct Life {
  uint32_t first = UINT32_MAX;
  uint32_t last = 0;
  std::set<Access> reads;
  Access write = Access::none;
};

std::vector<Life> lives_of(const Plan& plan) {
  std::vector<Life> lives(plan.graph.values.size());
  for (uint32_t step = 0; step < plan.steps.size(); ++step) {
    const auto at = [&](ValueId value) -> Life& {
      lives[value].first = std::min(lives[value].first, step);
      lives[value].last = std::max(lives[value].last, step);
      return lives[value];
    };
    const GraphPass& pass = plan.graph.passes[plan.steps[step].pass];
    for (const Use& use : pass.inputs) at(use.value).reads.insert(use.access);
    for (const Use& use : pass.outputs) at(use.value).write = use.access;
    for (const Use& use : pass.scratch) at(use.value).write = use.access;
    for (const Observation& observation : plan.steps[step].observations)
      at(observation.value).reads.insert(access_of(observation.observer));
  }
  return lives;
}

/// Holds every byte of every heap against its tenants in turn, around the end of the frame: each must wait for all that
/// the one before it did last.
void expect_sound(const Plan& plan, const MemorySharing& sharing, const std::vector<MemoryNeed>& needs) {
  const std::vector<Life> lives = lives_of(plan);
  for (uint32_t heap = 0; heap < sharing.heaps.size(); ++heap) {
    std::set<uint64_t> edges;
    std::vector<ValueId> tenants;
    for (ValueId value = 0; value < needs.size(); ++value) {
      if (!sharing.places[value] || sharing.places[value]->heap != heap) continue;
      tenants.push_back(value);
      edges.insert(sharing.places[value]->offset);
      ASSERT_LE(sharing.places[value]->offset + needs[value].size, sharing.heaps[heap].bytes);
    }
    for (const uint64_t byte : edges) {
      std::vector<ValueId> there;
      for (const ValueId value : tenants)
        if (sharing.places[value]->offset <= byte && byte < sharing.places[value]->offset + needs[value].size)
          there.push_back(value);
      std::sort(there.begin(), there.end(), [&](ValueId a, ValueId b) { return lives[a].first < lives[b].first; });
      for (size_t i = 0; there.size() > 1 && i < there.size(); ++i) {
        const ValueId before = there[(i + there.size() - 1) % there.size()];
        const ValueId after = there[i];
        if (i > 0) {
          ASSERT_LT(lives[before].last, lives[after].first)
              << value_name(plan.graph.values[before]) << " and " << value_name(plan.graph.values[after]);
        }
        std::set<Access> waited;
        for (const Barrier& barrier : plan.steps[lives[after].first].barriers)
          if (barrier.takes_over && barrier.value == after) waited.insert(barrier.from);
        std::set<Access> demanded = lives[before].reads;
        if (demanded.empty()) demanded = {lives[before].write};
        for (const Access access : demanded) {
          EXPECT_TRUE(waited.contains(access))
              << value_name(plan.graph.values[after]) << " does not wait for " << value_name(plan.graph.values[before]);
        }
      }
    }
  }
}

TEST(ShareMemory, a_chain_needs_two_images) {
  Plan plan = plan_of(file(R"("s": {"type": "source"}, "f": {"type": "filter", "in": {"x": "s.a"}},
      "g": {"type": "filter", "in": {"x": "f.a"}}, "h": {"type": "filter", "in": {"x": "g.a"}},
      "o": {"type": "filter", "in": {"x": "h.a"}})",
                           R"("o": "o.a")"));
  const std::vector<MemoryNeed> needs = needs_of(plan.graph);
  const MemorySharing sharing = share_memory(plan, needs);
  ASSERT_EQ(sharing.heaps.size(), 1U);
  EXPECT_EQ(sharing.heaps[0].bytes, 2 * needs[0].size);
  EXPECT_EQ(sharing.heaps[0].unshared, 4 * needs[0].size);
  expect_sound(plan, sharing, needs);
  std::vector<std::string> reasons;
  for (const PlanStep& step : plan.steps)
    for (const Barrier& barrier : step.barriers)
      if (barrier.takes_over)
        reasons.push_back(value_name(plan.graph.values[barrier.value]) + (barrier.previous_frame ? " @1 " : " ") +
                          barrier.reason);
  EXPECT_EQ(reasons,
            (std::vector<std::string>{"s.a @1 takes over the memory of g.a", "f.a @1 takes over the memory of h.a",
                                      "g.a takes over the memory of s.a", "h.a takes over the memory of f.a"}));
}

TEST(ShareMemory, what_crosses_frames_or_leaves_the_graph_has_memory_of_its_own) {
  Plan plan = plan_of(file(R"("s": {"type": "source"}, "t": {"type": "still"},
      "p": {"type": "patch", "in": {"x": "s.a"}},
      "c": {"type": "accumulate", "in": {"x": "p.a", "last": "c.a@1"}},
      "m": {"type": "mix", "in": {"x": "c.a", "y": "t.a"}},
      "f": {"type": "filter", "in": {"x": "m.a"}})",
                           R"("o": "f.a")"));
  const MemorySharing sharing = share_memory(plan, needs_of(plan.graph));
  std::vector<std::string> shared;
  for (ValueId value = 0; value < plan.graph.values.size(); ++value)
    if (sharing.places[value]) shared.push_back(value_name(plan.graph.values[value]));
  EXPECT_EQ(shared, (std::vector<std::string>{"s.a", "m.a", "m.tmp"}));
}

TEST(ShareMemory, random_graphs_are_sound) {
  uint32_t takeovers = 0;
  for (uint32_t seed = 0; seed < 200; ++seed) {
    LinkOptions options;
    if (seed % 2 == 1) options.captures = {"*"};
    Plan plan = plan_of(toy::random_graph(seed, 24), options);
    const uint64_t hash = plan_hash(plan);
    const std::vector<MemoryNeed> needs = needs_of(plan.graph);
    const MemorySharing sharing = share_memory(plan, needs);
    expect_sound(plan, sharing, needs);
    EXPECT_EQ(plan_hash(plan), hash) << "sharing changed what the graph says";
    for (const PlanStep& step : plan.steps)
      takeovers += static_cast<uint32_t>(std::count_if(step.barriers.begin(), step.barriers.end(),
                                                       [](const Barrier& barrier) { return barrier.takes_over; }));
    if (HasFailure()) FAIL() << "seed " << seed;
  }
  EXPECT_GT(takeovers, 1000u);
}

TEST(ShareMemory, the_graphs_that_ship_stay_within_five_percent_of_the_bound) {
  for (const char* name : {"paper.json", "lightloom.json", "stages.json"}) {
    for (const bool dynamic : {false, true}) {
      LinkEnvironment scene = toy::environment(dynamic);
      scene.scene_features = {{"dynamic", dynamic}, {"emissive", true}, {"specular", true}};
      Plan plan = compile(toy::graph_of(read_text_file(source_dir() / "graphs" / name), {}, real_passes(), scene));
      const std::vector<MemoryNeed> needs = needs_of(plan.graph);
      const MemorySharing sharing = share_memory(plan, needs);
      expect_sound(plan, sharing, needs);
      for (const SharedHeap& heap : sharing.heaps)
        EXPECT_LE(static_cast<double>(heap.bytes), 1.05 * static_cast<double>(heap.lower_bound)) << name;
    }
  }
}

}  // namespace
}  // namespace lightloom
