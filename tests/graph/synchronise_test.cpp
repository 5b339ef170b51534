#include "framework/graph/synchronise.hpp"

#include <gtest/gtest.h>

#include "framework/base/text.hpp"
#include "framework/graph/verify.hpp"
#include "tests/support/random_graph.hpp"
#include "tests/support/toy_graphs.hpp"

namespace lightloom {
namespace {

using toy::file;
using toy::plan_of;

template <class Visit>
void for_each_list(Plan& plan, Visit visit) {
  visit(plan.prologue_barriers);
  visit(plan.frame_start);
  visit(plan.inputs_ready);
  visit(plan.once_barriers);
  for (Observation& observation : plan.opening_observations) visit(observation.barriers);
  for (std::vector<PlanStep>* steps : {&plan.once, &plan.steps}) {
    for (PlanStep& step : *steps) {
      visit(step.barriers);
      for (Observation& observation : step.observations) visit(observation.barriers);
    }
  }
}

std::vector<Barrier> all_barriers(Plan plan) {
  std::vector<Barrier> all;
  for_each_list(plan, [&](std::vector<Barrier>& list) { all.insert(all.end(), list.begin(), list.end()); });
  return all;
}

/// The plan with its n-th barrier changed by `change`, which may also erase it from its list.
template <class Change>
Plan mutated(const Plan& plan, std::size_t n, Change change) {
  Plan mutant = plan;
  std::size_t before = 0;
  for_each_list(mutant, [&](std::vector<Barrier>& list) {
    const std::size_t count = list.size();
    if (n >= before && n < before + count) change(list, n - before);
    before += count;
  });
  return mutant;
}

std::vector<std::string> on_value(const Plan& plan, const std::string& name) {
  std::vector<std::string> texts;
  for (const Barrier& barrier : all_barriers(plan)) {
    if (barrier.value == kFrameInputs || value_name(plan.graph.values[barrier.value]) != name) continue;
    texts.push_back(std::string(access_info(barrier.from).name) + " -> " + std::string(access_info(barrier.to).name) +
                    (barrier.previous_frame ? " (previous frame)" : ""));
  }
  return texts;
}

const std::string kChain =
    R"("s": {"type": "source"}, "f": {"type": "filter", "in": {"x": "s.a"}},
       "g": {"type": "filter", "in": {"x": "f.a", "y": "s.a"}})";

TEST(Synchronise, OneBarrierServesAllReadersOfOneKind) {
  const Plan plan = plan_of(file(kChain, R"("o": "g.a")"));
  EXPECT_EQ(on_value(plan, "s.a"),
            (std::vector<std::string>{"compute_sampled_read -> compute_storage_write (previous frame)",
                                      "compute_storage_write -> compute_sampled_read"}));
  EXPECT_TRUE(verify(plan).violations.empty());
}

TEST(Synchronise, ReadersOfOtherStagesAreWidenedInAtTheFirst) {
  const Plan plan = plan_of(file(R"("s": {"type": "source"}, "f": {"type": "filter", "in": {"x": "s.a"}},
      "h": {"type": "shade", "in": {"x": "s.a"}}, "m": {"type": "mix", "in": {"x": "f.a", "y": "h.a"}})",
                                 R"("o": "m.a")"));
  EXPECT_EQ(plan.steps[1].barriers.size(), 3U) << print_plan(plan);
  EXPECT_EQ(on_value(plan, "s.a"),
            (std::vector<std::string>{"compute_sampled_read -> compute_storage_write (previous frame)",
                                      "fragment_sampled_read -> compute_storage_write (previous frame)",
                                      "compute_storage_write -> compute_sampled_read",
                                      "compute_storage_write -> fragment_sampled_read"}));
}

TEST(Synchronise, ScratchWaitsForItsOwnLastFrame) {
  const Plan plan = plan_of(
      file(R"("s": {"type": "source"}, "m": {"type": "mix", "in": {"x": "s.a", "y": "s.a"}})", R"("o": "m.a")"));
  EXPECT_EQ(on_value(plan, "m.tmp"),
            (std::vector<std::string>{"compute_storage_read_write -> compute_storage_read_write (previous frame)"}));
}

TEST(Synchronise, OwnHistoryIsASteadyRound) {
  const Plan plan =
      plan_of(file(R"("s": {"type": "source"}, "c": {"type": "accumulate", "in": {"x": "s.a", "last": "c.a@1"}},
                      "f": {"type": "filter", "in": {"x": "s.a", "y": "c.a@1"}})",
                   R"("o": "f.a", "p": "s.a")"));
  // The prologue's clear joins the chain that every frame repeats.
  EXPECT_EQ(on_value(plan, "c.a"),
            (std::vector<std::string>{"transfer_write -> compute_storage_write",
                                      "compute_storage_write -> compute_sampled_read (previous frame)",
                                      "compute_sampled_read -> compute_storage_write (previous frame)"}));
  EXPECT_TRUE(verify(plan).violations.empty());
}

TEST(Synchronise, CopiesStandRightBehindTheProducer) {
  LinkOptions options;
  options.captures = {"*"};
  const Plan plan = plan_of(file(kChain, R"("o": "g.a")"), options);
  for (const PlanStep& step : plan.steps) {
    ASSERT_EQ(step.observations.size(), 1U);
    EXPECT_EQ(plan.graph.values[step.observations[0].value].pass, plan.graph.passes[step.pass].name);
  }
  EXPECT_TRUE(verify(plan).violations.empty());
}

TEST(Synchronise, ConstantsAreClearedOnceAndNeverWaitedForAgain) {
  LinkOptions options;
  options.disables = {"b"};
  options.hoist = false;
  const Plan plan = plan_of(file(R"("s": {"type": "source"}, "b": {"type": "black", "in": {"x": "s.a"}},
                                   "f": {"type": "filter", "in": {"x": "b.a"}})",
                                 R"("o": "f.a", "k": "b.a")"),
                            options);
  ASSERT_EQ(plan.prologue.size(), 1U);
  EXPECT_EQ(plan.prologue[0].color, (ClearColor{0, 0, 0, 1}));
  EXPECT_EQ(plan.opening_observations.size(), 1U);
  EXPECT_EQ(toy::order(plan), std::vector<std::string>{"f"});
  EXPECT_EQ(on_value(plan, "b.a"),
            (std::vector<std::string>{"transfer_write -> compute_sampled_read", "transfer_write -> transfer_read"}));
  EXPECT_TRUE(verify(plan).violations.empty());
}

TEST(Synchronise, WhatIsWrittenOnceIsWaitedForOnce) {
  LinkOptions options;
  options.captures = {"k.a", "m.tmp"};
  const Plan plan = plan_of(file(R"("k": {"type": "still"}, "s": {"type": "source"},
      "m": {"type": "mix", "in": {"x": "k.a", "y": "k.a"}},
      "f": {"type": "filter", "in": {"x": "k.a"}}, "g": {"type": "mix", "in": {"x": "f.a", "y": "s.a"}},
      "h": {"type": "shade", "in": {"x": "m.a"}}, "i": {"type": "mix", "in": {"x": "g.a", "y": "m.a"}})",
                                 R"("o": "i.a", "p": "h.a")"),
                            options);
  ASSERT_EQ(plan.once.size(), 4U) << print_plan(plan);
  // Before the first to read it, who is hoisted as well, for all who ever do; never again.
  EXPECT_EQ(on_value(plan, "k.a"), (std::vector<std::string>{"compute_storage_write -> compute_sampled_read",
                                                             "compute_storage_write -> transfer_read"}));
  EXPECT_EQ(plan.once[1].barriers.size(), 2U);
  // Where frames alone read it: after the last of those that run once.
  EXPECT_EQ(on_value(plan, "f.a"), (std::vector<std::string>{"compute_storage_write -> compute_sampled_read"}));
  EXPECT_EQ(on_value(plan, "m.tmp"), (std::vector<std::string>{"compute_storage_read_write -> transfer_read"}));
  EXPECT_EQ(on_value(plan, "h.a"), (std::vector<std::string>{"color_attachment_write -> transfer_read"}));
  EXPECT_EQ(plan.opening_observations.size(), 3U);
  EXPECT_TRUE(verify(plan).violations.empty());
}

TEST(Synchronise, APersistentValueIsClearedOnceAndThenARound) {
  const Plan plan = plan_of(file(R"("s": {"type": "source"}, "p": {"type": "patch", "in": {"x": "s.a"}},
      "f": {"type": "shade", "in": {"x": "p.a"}})",
                                 R"("o": "f.a")"));
  ASSERT_EQ(plan.prologue.size(), 2U) << print_plan(plan);
  EXPECT_EQ(on_value(plan, "p.a"),
            (std::vector<std::string>{"transfer_write -> compute_storage_write",
                                      "fragment_sampled_read -> compute_storage_write (previous frame)",
                                      "compute_storage_write -> fragment_sampled_read"}));
  EXPECT_EQ(on_value(plan, "p.memo"),
            (std::vector<std::string>{"transfer_write -> compute_storage_read_write",
                                      "compute_storage_read_write -> compute_storage_read_write (previous frame)"}));
  EXPECT_TRUE(verify(plan).violations.empty());
}

struct Mutants {
  std::size_t found = 0;
  std::size_t superfluous = 0;
};

/// Every mutation of every barrier must be found. One kind may be superfluous: in a ring, where the last to read a
/// layer uses another stage, readers that are done frames before are already held by the barriers of the frames
/// between.
void expect_minimal(const Plan& plan, Mutants& mutants) {
  const std::vector<Barrier> barriers = all_barriers(plan);
  for (std::size_t n = 0; n < barriers.size(); ++n) {
    const Barrier& barrier = barriers[n];
    const auto found = [&](auto change) { return !verify(mutated(plan, n, change), {}, 1).violations.empty(); };
    if (!found([](auto& list, std::size_t i) { list.erase(list.begin() + static_cast<std::ptrdiff_t>(i)); })) {
      ++mutants.superfluous;
      EXPECT_EQ(barrier.hazard, Hazard::write_after_read) << print_plan(plan);
      EXPECT_TRUE(barrier.value != kFrameInputs && plan.graph.values[barrier.value].history > 0) << print_plan(plan);
      continue;
    }
    const std::string which = std::string(access_info(barrier.from).name) + " -> " +
                              std::string(access_info(barrier.to).name) + "\n" + print_plan(plan);
    EXPECT_TRUE(found([](auto& list, std::size_t i) { list[i].from = Access::host_read; })) << which;
    EXPECT_TRUE(found([](auto& list, std::size_t i) { list[i].to = Access::host_read; })) << which;
    mutants.found += 3;
  }
}

TEST(Synchronise, RandomGraphsHaveNoHazardAndNoSuperfluousBarrier) {
  Mutants mutants;
  std::size_t steps = 0;
  std::size_t rings = 0;
  std::size_t once = 0;
  std::size_t kept = 0;
  for (uint32_t seed = 0; seed < 300; ++seed) {
    LinkOptions options;
    if (seed % 3 == 1) options.captures = {"*"};
    if (seed % 3 == 2) options.captures = {"p?.*"};
    const Plan plan = plan_of(toy::random_graph(seed, 3 + static_cast<int>(seed % 12)), options);
    const std::vector<std::string> hazards = verify(plan).violations;
    ASSERT_TRUE(hazards.empty()) << "seed " << seed << ": " << join(hazards, "\n") << "\n" << print_plan(plan);
    if (seed < 60) expect_minimal(plan, mutants);
    if (testing::Test::HasFailure()) FAIL() << "seed " << seed;
    steps += plan.steps.size();
    once += plan.once.size();
    for (const Value& value : plan.graph.values) {
      rings += value.history > 0 ? 1 : 0;
      kept += value.persistent ? 1 : 0;
    }
  }
  EXPECT_GT(mutants.found, 1000U);
  EXPECT_LT(mutants.superfluous * 100, mutants.found);
  RecordProperty("mutants_found", static_cast<int>(mutants.found));
  RecordProperty("superfluous", static_cast<int>(mutants.superfluous));
  EXPECT_GT(steps, 1000U);
  EXPECT_GT(rings, 200U);
  EXPECT_GT(once, 150U);
  EXPECT_GT(kept, 50U);
}

TEST(Verify, SeesAReadOfTheWrongFrame) {
  Plan plan = plan_of(file(R"("s": {"type": "source"}, "t": {"type": "trail", "in": {"x": "s.a", "past": "s.a@1..3"}})",
                           R"("o": "t.a")"));
  ASSERT_TRUE(verify(plan).violations.empty());
  for (Value& value : plan.graph.values)
    if (value.history > 0) --value.history;  // a ring that is one layer short
  EXPECT_FALSE(verify(plan).violations.empty());
}

TEST(Verify, SeesAMissingClear) {
  Plan plan = plan_of(file(R"("s": {"type": "source"}, "t": {"type": "trail", "in": {"x": "s.a", "past": "s.a@1..3"}})",
                           R"("o": "t.a")"));
  plan.prologue.clear();
  EXPECT_FALSE(verify(plan).violations.empty());
}

TEST(Verify, SeesAPersistentValueThatWasNeverCleared) {
  Plan plan = plan_of(file(R"("s": {"type": "source"}, "p": {"type": "patch", "in": {"x": "s.a"}})", R"("o": "p.a")"));
  ASSERT_TRUE(verify(plan).violations.empty());
  plan.prologue.clear();
  EXPECT_FALSE(verify(plan).violations.empty());
}

}  // namespace
}  // namespace lightloom
