#include "framework/graph/verify.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <utility>

#include "framework/base/file.hpp"
#include "framework/base/text.hpp"
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

/// A plan with the memory that its values share.
struct Case {
  Plan plan;
  std::vector<MemoryNeed> needs;
  MemorySharing sharing;

  explicit Case(Plan from) : plan(std::move(from)), needs(needs_of(plan.graph)), sharing(share_memory(plan, needs)) {}
  [[nodiscard]] std::vector<std::string> violations() const { return verify(plan, {&sharing, needs}, 1).violations; }
};

TEST(Verify, RandomGraphsThatShareMemoryAreSound) {
  uint64_t pairs = 0;
  for (uint32_t seed = 0; seed < 150; ++seed) {
    LinkOptions options;
    if (seed % 3 == 1) options.captures = {"*"};
    const Case one(plan_of(toy::random_graph(seed, 3 + static_cast<int>(seed % 20)), options));
    const Verification result = verify(one.plan, {&one.sharing, one.needs});
    ASSERT_TRUE(result.violations.empty()) << "seed " << seed << ": " << join(result.violations, "\n") << "\n"
                                           << print_plan(one.plan);
    EXPECT_GE(result.frames, 3u);
    pairs += result.pairs;
  }
  EXPECT_GT(pairs, 40'000u);
}

struct Count {
  uint32_t caught = 0;
  uint32_t redundant = 0;
};

/// Mutants of what sharing added: a takeover that is gone, or waits for somebody else, or reaches somebody else.
void mutate_takeovers(const Case& sound, Count& count) {
  for (std::size_t step = 0; step < sound.plan.steps.size(); ++step) {
    for (std::size_t n = 0; n < sound.plan.steps[step].barriers.size(); ++n) {
      if (!sound.plan.steps[step].barriers[n].takes_over) continue;
      Case mutant = sound;
      std::vector<Barrier>& list = mutant.plan.steps[step].barriers;
      list[n].from = Access::host_read;
      const bool source = !mutant.violations().empty();
      // Where two accesses are waited for, the stages of one may be those of the other.
      const bool alone = std::count_if(list.begin(), list.end(), [&](const Barrier& other) {
                           return other.takes_over && other.value == list[n].value;
                         }) == 1;
      EXPECT_TRUE(source || !alone) << print_plan(sound.plan);
      ++(source ? count.caught : count.redundant);
      if (!alone) continue;
      list[n] = sound.plan.steps[step].barriers[n];
      list[n].to = Access::host_read;
      EXPECT_FALSE(mutant.violations().empty()) << print_plan(sound.plan);
      list.erase(list.begin() + static_cast<std::ptrdiff_t>(n));
      EXPECT_FALSE(mutant.violations().empty()) << print_plan(sound.plan);
      count.caught += 2;
    }
  }
}

/// Every value moved to where each other one begins. Harmless only if the two, and all between, still take turns.
void mutate_offsets(const Case& sound, Count& count) {
  for (ValueId moved = 0; moved < sound.needs.size(); ++moved) {
    for (ValueId target = 0; target < sound.needs.size(); ++target) {
      if (!sound.sharing.places[moved] || !sound.sharing.places[target] ||
          sound.sharing.places[moved]->heap != sound.sharing.places[target]->heap ||
          sound.sharing.places[moved]->offset == sound.sharing.places[target]->offset)
        continue;
      Case mutant = sound;
      mutant.sharing.places[moved] = sound.sharing.places[target];
      ++(mutant.violations().empty() ? count.redundant : count.caught);
    }
  }
}

void swap_steps(const Case& sound, Count& count) {
  for (std::size_t step = 0; step + 1 < sound.plan.steps.size(); ++step) {
    Case mutant = sound;
    std::swap(mutant.plan.steps[step], mutant.plan.steps[step + 1]);
    ++(mutant.violations().empty() ? count.redundant : count.caught);
  }
}

TEST(Verify, MutantsAreCaught) {
  Count takeovers;
  Count offsets;
  Count swaps;
  for (uint32_t seed = 0; seed < 40; ++seed) {
    const Case sound(plan_of(toy::random_graph(seed, 12)));
    ASSERT_TRUE(sound.violations().empty());
    mutate_takeovers(sound, takeovers);
    mutate_offsets(sound, offsets);
    swap_steps(sound, swaps);
    if (HasFailure()) FAIL() << "seed " << seed;
  }
  for (const auto& [name, count] : {std::pair("takeovers", takeovers), {"offsets", offsets}, {"swaps", swaps}})
    std::cout << name << ": " << count.caught << " mutants caught, " << count.redundant << " redundant\n";
  EXPECT_GT(takeovers.caught, 100u);
  EXPECT_LT(takeovers.redundant * 20, takeovers.caught);
  EXPECT_GT(offsets.caught, 100u);
  EXPECT_GT(swaps.caught, 100u);
}

TEST(Verify, SeesAnOrderThatReadsBeforeItIsWritten) {
  Plan plan = plan_of(file(R"("s": {"type": "source"}, "f": {"type": "filter", "in": {"x": "s.a"}})", R"("o": "f.a")"));
  std::swap(plan.steps[0], plan.steps[1]);
  const std::vector<std::string> violations = verify(plan).violations;
  ASSERT_FALSE(violations.empty());
  EXPECT_NE(join(violations, "\n").find("s.a: f finds what is undefined instead of what frame 0 wrote"),
            std::string::npos)
      << join(violations, "\n");
}

TEST(Verify, SeesMemoryThatWasNotTakenOver) {
  Case one(plan_of(file(R"("s": {"type": "source"}, "f": {"type": "filter", "in": {"x": "s.a"}},
      "g": {"type": "filter", "in": {"x": "f.a"}}, "h": {"type": "filter", "in": {"x": "g.a"}})",
                        R"("o": "h.a")")));
  ASSERT_TRUE(one.violations().empty());
  for (PlanStep& step : one.plan.steps)
    std::erase_if(step.barriers, [](const Barrier& barrier) { return barrier.takes_over; });
  const std::vector<std::string> violations = one.violations();
  ASSERT_FALSE(violations.empty());
  EXPECT_NE(violations.front().find("was not taken over"), std::string::npos) << violations.front();
}

TEST(Verify, ScannedPlansAreSound) {
  for (uint32_t seed = 0; seed < 40; ++seed) {
    const Graph graph = toy::graph_of(toy::random_graph(seed, 12));
    const Case scanned(compile(graph, {.scan = true}));
    EXPECT_EQ(scanned.violations(), std::vector<std::string>{}) << "seed " << seed;
    size_t scans = 0;
    for (const auto* steps : {&scanned.plan.once, &scanned.plan.steps})
      for (const PlanStep& step : *steps)
        scans +=
            static_cast<size_t>(std::count_if(step.observations.begin(), step.observations.end(),
                                              [](const Observation& each) { return each.observer == Observer::scan; }));
    const auto constants = std::count_if(graph.values.begin(), graph.values.end(),
                                         [](const Value& value) { return value.constant.has_value(); });
    EXPECT_EQ(scans, graph.values.size() - static_cast<size_t>(constants)) << "seed " << seed;
  }
}

TEST(Verify, ConservativePlansAreSoundWithOneBarrierAtEachPlace) {
  uint32_t caught = 0;
  for (uint32_t seed = 0; seed < 40; ++seed) {
    LinkOptions link;
    if (seed % 2 == 1) link.captures = {"*"};
    const Graph graph = toy::graph_of(toy::random_graph(seed, 12), link);
    const Case one(compile(graph, {.sync = SyncPolicy::conservative, .scan = seed % 3 == 0}));
    ASSERT_EQ(one.violations(), std::vector<std::string>{}) << "seed " << seed;
    for (const PlanStep& step : one.plan.steps) {
      const auto own = std::count_if(step.barriers.begin(), step.barriers.end(),
                                     [](const Barrier& barrier) { return !barrier.takes_over; });
      EXPECT_EQ(own, 1);
    }
    // Where the barrier of a neighbour serves as well, nothing is missing.
    Case mutant = one;
    for (PlanStep& step : mutant.plan.steps) {
      const std::vector<Barrier> barriers = std::exchange(step.barriers, {});
      caught += mutant.violations().empty() ? 0 : 1;
      step.barriers = barriers;
    }
  }
  EXPECT_GT(caught, 40u);
}

TEST(Verify, BarriersOfOneBatchDoNotCarryOn) {
  Plan plan = plan_of(file(R"("s": {"type": "source"}, "f": {"type": "shade", "in": {"x": "s.a"}})", R"("o": "f.a")"));
  ASSERT_TRUE(verify(plan).violations.empty());
  std::vector<Barrier>& list = plan.steps[1].barriers;
  const auto read = std::find_if(list.begin(), list.end(), [&](const Barrier& barrier) {
    return value_name(plan.graph.values[barrier.value]) == "s.a";
  });
  ASSERT_NE(read, list.end());
  ASSERT_EQ(read->to, Access::fragment_sampled_read);
  // By way of the transfer: right in two batches, wrong in one.
  const Barrier direct = *read;
  read->to = Access::transfer_read;
  list.push_back(direct);
  list.back().from = Access::transfer_read;
  EXPECT_FALSE(verify(plan).violations.empty());
}

TEST(Verify, TheGraphsThatShipAreSound) {
  for (const char* name : {"paper.json", "lightloom.json", "stages.json", "reference.json"}) {
    for (const bool dynamic : {false, true}) {
      LinkEnvironment scene = toy::environment(dynamic);
      scene.scene_features = {{"dynamic", dynamic}, {"emissive", true}, {"specular", true}};
      const Graph graph = toy::graph_of(read_text_file(source_dir() / "graphs" / name), {}, real_passes(), scene);
      for (const SyncPolicy policy : {SyncPolicy::minimal, SyncPolicy::conservative})
        EXPECT_EQ(Case(compile(graph, {.sync = policy})).violations(), std::vector<std::string>{}) << name;
    }
  }
}

}  // namespace
}  // namespace lightloom
