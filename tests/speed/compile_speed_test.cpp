// How the time from a graph's text to its plan grows with the number of passes: CompileSpeed.* prints the table of
// docs/performance.md. Processor time, so that it can be measured beside other work.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "framework/graph/hoist.hpp"
#include "framework/graph/schedule.hpp"
#include "framework/graph/share_memory.hpp"
#include "framework/graph/synchronise.hpp"
#include "framework/graph/verify.hpp"
#include "tests/graph/memory_needs.hpp"
#include "tests/support/big_graphs.hpp"
#include "tests/support/toy_graphs.hpp"

namespace lightloom {
namespace {

enum Phase : uint8_t { parse, link_it, hoist_it, order, barriers, compiled, shared, hashed, printed, verified, phases };
constexpr std::array<const char*, phases> kNames = {"parse",   "link",         "hoist", "schedule", "synchronise",
                                                    "compile", "share memory", "hash",  "print",    "verify"};
using Times = std::array<double, phases>;  ///< [ms]

double milliseconds(const std::function<void()>& work) {
  timespec begin{};
  timespec end{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &begin);
  work();
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &end);
  return static_cast<double>(end.tv_sec - begin.tv_sec) * 1e3 + static_cast<double>(end.tv_nsec - begin.tv_nsec) * 1e-6;
}

Plan without_barriers(Plan plan) {
  plan.prologue.clear();
  for (auto* list : {&plan.prologue_barriers, &plan.once_barriers, &plan.frame_start, &plan.inputs_ready})
    list->clear();
  for (auto* steps : {&plan.once, &plan.steps})
    for (PlanStep& step : *steps) {
      step.barriers.clear();
      for (Observation& observation : step.observations) observation.barriers.clear();
    }
  for (Observation& observation : plan.opening_observations) observation.barriers.clear();
  return plan;
}

/// One way from text to plan, and what is done with plans.
Times once_through(const std::string& text) {
  Times times{};
  Diagnostics diagnostics;
  std::optional<GraphSpec> spec;
  std::optional<Graph> graph;
  times[parse] = milliseconds([&] { spec = parse_graph(text, "graph.json", diagnostics); });
  LinkOptions options;
  options.hoist = false;
  const LinkEnvironment environment = toy::environment();
  times[link_it] = milliseconds([&] { graph = link(*spec, toy::registry(), options, environment, diagnostics); });
  EXPECT_TRUE(graph.has_value());
  if (!graph) return times;
  times[hoist_it] = milliseconds([&] { hoist(*graph, environment.changing); });
  times[order] = milliseconds([&] { static_cast<void>(schedule(*graph)); });
  Plan plan;
  times[compiled] = milliseconds([&] { plan = compile(*graph); });
  Plan bare = without_barriers(plan);
  times[barriers] = milliseconds([&] { synchronise(bare); });
  times[hashed] = milliseconds([&] { static_cast<void>(plan_hash(plan)); });
  times[printed] = milliseconds([&] { static_cast<void>(print_plan(plan)); });
  const std::vector<MemoryNeed> needs = toy::needs_of(*graph);
  MemorySharing sharing;
  times[shared] = milliseconds([&] { sharing = share_memory(plan, needs); });
  Verification verification;
  times[verified] = milliseconds([&] { verification = verify(plan, {&sharing, needs}); });
  EXPECT_TRUE(verification.violations.empty()) << verification.violations.front();
  return times;
}

/// The least of several runs: what else the machine does only adds to a time.
struct LeastTimes {
  Times times{};
  std::size_t runs = 0;

  void add_run(const std::string& text) {
    const Times run = once_through(text);
    for (std::size_t phase = 0; phase < phases; ++phase)
      times.at(phase) = runs == 0 ? run.at(phase) : std::min(times.at(phase), run.at(phase));
    ++runs;
  }
};

/// What stands between a file's text and its plan; `compile` holds schedule and synchronise.
double to_plan(const Times& times) {
  return times[parse] + times[link_it] + times[hoist_it] + times[compiled];
}

void print_table(const char* shape, const Times& small, const Times& large) {
  std::printf(
      "\n| %s | 1,000 passes [ms] | 10,000 passes [ms] | growth of the time of a pass |\n| --- | --- | --- | --- |\n",
      shape);
  const auto row = [](const char* name, double a, double b) {
    std::printf("| %s | %.2f | %.2f | %.2f |\n", name, a, b, b / a / 10);
  };
  for (std::size_t phase = 0; phase < phases; ++phase) row(kNames.at(phase), small.at(phase), large.at(phase));
  row("text to plan", to_plan(small), to_plan(large));
}

constexpr double kMostGrowth = 4;  // of the time of a pass, for caches and a busy machine; quadratic growth would be 10

void expect_linear(const char* shape, const std::function<std::string(uint32_t)>& text) {
  LeastTimes few;
  LeastTimes many;
  const std::string small_text = text(1000);
  const std::string large_text = text(10000);
  // In turn, so that a slow spell of the machine meets both.
  for (int round = 0; round < 5; ++round) {
    for (int i = 0; i < 3; ++i) few.add_run(small_text);
    many.add_run(large_text);
  }
  const Times& small = few.times;
  const Times& large = many.times;
  print_table(shape, small, large);
  EXPECT_LT(to_plan(small), 50);
  EXPECT_LT(to_plan(large), 10 * kMostGrowth * to_plan(small));
  for (const Phase phase : {shared, hashed, printed, verified}) {
    EXPECT_LT(small.at(phase), 200) << kNames.at(phase);
    EXPECT_LT(large.at(phase), 10 * kMostGrowth * small.at(phase)) << kNames.at(phase);
  }
}

TEST(CompileSpeed, Chain) {
  expect_linear("chain", toy::chain);
}
TEST(CompileSpeed, BackwardChain) {
  expect_linear("chain, last pass first in the file", toy::backward_chain);
}
TEST(CompileSpeed, Layers) {
  expect_linear("layers", [](uint32_t passes) { return toy::layers(passes, 1); });
}
TEST(CompileSpeed, Hub) {
  expect_linear("one pass that all others read", toy::hub);
}

}  // namespace
}  // namespace lightloom
