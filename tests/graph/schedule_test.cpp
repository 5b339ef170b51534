#include "framework/graph/schedule.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "tests/support/random_graph.hpp"
#include "tests/support/toy_graphs.hpp"

namespace lightloom {
namespace {

using toy::file;
using toy::order;
using toy::plan_of;

TEST(Schedule, ByLevelThenByDeclaration) {
  EXPECT_EQ(
      order(plan_of(file(R"("z": {"type": "filter", "in": {"x": "m.a"}}, "m": {"type": "filter", "in": {"x": "s.a"}},
      "s": {"type": "source"}, "b": {"type": "source"}, "y": {"type": "mix", "in": {"x": "m.a", "y": "b.a"}})",
                         R"("o": "z.a", "p": "y.a")"))),
      (std::vector<std::string>{"s", "b", "m", "z", "y"}));
}

TEST(Schedule, HistoryOrdersNothing) {
  EXPECT_EQ(order(plan_of(
                file(R"("f": {"type": "filter", "in": {"x": "s.a@1"}}, "s": {"type": "source"})", R"("o": "f.a")"))),
            (std::vector<std::string>{"f", "s"}));
}

/// A chain has one order, whatever the passes are called and in whatever order they stand in the file.
TEST(Schedule, NamesAndKeyOrderDoNotMatterWhereLevelsDiffer) {
  std::mt19937 random(3);
  for (int round = 0; round < 50; ++round) {
    std::vector<std::string> names;
    for (int i = 0; i < 8; ++i)
      names.push_back(std::string(1, static_cast<char>('a' + random() % 26)) + std::to_string(i));
    std::vector<std::string> entries{"\"" + names[0] + "\": {\"type\": \"source\"}"};
    for (std::size_t i = 1; i < names.size(); ++i)
      entries.push_back("\"" + names[i] + "\": {\"type\": \"filter\", \"in\": {\"x\": \"" + names[i - 1] + ".a\"}}");
    std::shuffle(entries.begin(), entries.end(), random);
    std::string passes;
    for (const std::string& entry : entries) passes += (passes.empty() ? "" : ",") + entry;
    EXPECT_EQ(order(plan_of(file(passes, "\"o\": \"" + names.back() + ".a\""))), names);
  }
}

TEST(Schedule, KeyOrderOfInputsAndParamsChangesNothing) {
  const std::string a = R"("s": {"type": "source", "params": {"level": 1, "count": 3}},
      "m": {"type": "mix", "in": {"x": "s.a", "y": "s.a@1"}})";
  const std::string b = R"("s": {"params": {"count": 3, "level": 1}, "type": "source"},
      "m": {"in": {"y": "s.a@1", "x": "s.a"}, "type": "mix"})";
  EXPECT_EQ(plan_hash(plan_of(file(a, R"("o": "m.a")"))), plan_hash(plan_of(file(b, R"("o": "m.a")"))));
}

TEST(Schedule, RandomGraphsRunProducersFirst) {
  for (uint32_t seed = 0; seed < 200; ++seed) {
    const Plan plan = plan_of(toy::random_graph(seed, 12));
    std::map<ValueId, bool> written;
    for (const std::vector<PlanStep>* steps : {&plan.once, &plan.steps}) {
      for (const PlanStep& step : *steps) {
        const GraphPass& pass = plan.graph.passes[step.pass];
        for (const Use& use : pass.inputs)
          EXPECT_TRUE(use.first_age > 0 || written[use.value] || plan.graph.values[use.value].constant)
              << "seed " << seed;
        for (const Use& use : pass.outputs) written[use.value] = true;
      }
    }
    EXPECT_EQ(plan.once.size() + plan.steps.size(), plan.graph.passes.size());
  }
}

TEST(Plan, SameGraphSamePlanAndText) {
  const std::string text = toy::random_graph(5, 14);
  EXPECT_EQ(plan_hash(plan_of(text)), plan_hash(plan_of(text)));
  EXPECT_EQ(print_plan(plan_of(text)), print_plan(plan_of(text)));
}

TEST(Plan, HashSeesWhatIsExecuted) {
  const auto hash = [](const std::string& params, const std::string& edge) {
    return plan_hash(plan_of(file(R"("s": {"type": "source", "params": {)" + params +
                                      R"(}}, "f": {"type": "filter", "in": {"x": ")" + edge + R"("}})",
                                  R"("o": "f.a")")));
  };
  const uint64_t base = hash("", "s.a");
  EXPECT_EQ(hash(R"("level": 0.5)", "s.a"), base);  // the default
  EXPECT_NE(hash(R"("level": 0.25)", "s.a"), base);
  EXPECT_NE(hash("", "s.a@1"), base);
  EXPECT_NE(hash("", "s.a@1"), hash("", "s.a@2"));
}

TEST(Plan, MemoryCountsEveryLayer) {
  const Plan plan =
      plan_of(file(R"("s": {"type": "source"}, "f": {"type": "filter", "in": {"x": "s.a@3"}})", R"("o": "f.a")"));
  const uint64_t image = 64 * 48 * 8;
  EXPECT_EQ(memory_use(plan.graph).total, 5 * image);
  EXPECT_EQ(memory_use(plan.graph).rings, 4 * image);
}

TEST(Plan, TextNamesWhatMatters) {
  LinkOptions options;
  options.disables = {"g"};
  options.captures = {"f.a"};
  const std::string text = print_plan(plan_of(
      file(
          R"("s": {"type": "source"}, "f": {"type": "filter", "in": {"x": "s.a@3"}}, "g": {"type": "filter", "in": {"x": "f.a"}},
              "unused": {"type": "source"})",
          R"("o": "g.a")"),
      options));
  for (const char* piece : {"1. s (source)", "in  x = s.a@3", "in  y: not connected", "2. f (filter) strength=1.0",
                            "ring of 4", "rgba16_sfloat 64x48", "s.a: compute_storage_write -> compute_sampled_read",
                            "read back f.a", "unused: no output", "g: disabled by --disable", "o = f.a"})
    EXPECT_NE(text.find(piece), std::string::npos) << piece << "\n" << text;
}

}  // namespace
}  // namespace lightloom
