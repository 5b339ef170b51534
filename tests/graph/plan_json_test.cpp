#include "framework/graph/plan_json.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "framework/graph/critical_path.hpp"
#include "framework/graph/lifetime.hpp"
#include "tests/graph/memory_needs.hpp"
#include "tests/graph/real_passes.hpp"
#include "tests/support/random_graph.hpp"
#include "tests/support/schema_check.hpp"
#include "tests/support/toy_graphs.hpp"

// Plans as data: against their schema, and against what the plan itself says.
namespace lightloom {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Plans of graphs that ship, in several ways, and of random ones.
std::vector<Plan> sample_plans() {
  LinkEnvironment all = toy::environment();
  for (const char* feature : {"emissive", "specular"}) all.scene_features.emplace_back(feature, true);
  std::vector<Plan> plans;
  for (const char* name : {"paper", "lightloom", "stages", "reference"}) {
    const std::string text = read_text_file(source_dir() / "graphs" / (std::string(name) + ".json"));
    LinkOptions options;
    plans.push_back(compile(toy::graph_of(text, options, real_passes(), all)));
    options.captures = {"*"};
    options.hoist = false;
    plans.push_back(compile(toy::graph_of(text, options, real_passes(), all), {.sync = SyncPolicy::conservative}));
  }
  for (uint32_t seed = 0; seed < 10; ++seed) plans.push_back(toy::plan_of(toy::random_graph(seed, 14)));
  return plans;
}

PlanFacts facts_of(Plan& plan, uint32_t seed) {
  PlanFacts facts;
  facts.memory = PlanFacts::Memory{toy::needs_of(plan.graph), {}};
  facts.memory->sharing = share_memory(plan, facts.memory->needs);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> time(0, 10);
  facts.times = PlanFacts::Times{"out/run", {}};
  for (size_t i = 0; i < plan.steps.size(); ++i) facts.times->step_ms.push_back(time(random));
  return facts;
}

TEST(PlanJson, IsWhatItsSchemaSays) {
  const test::SchemaFolder folder;
  std::vector<fs::path> files;
  const auto add = [&](const Json& json) { files.push_back(folder.write(std::to_string(files.size()), json.dump())); };
  for (Plan& plan : sample_plans()) {
    add(plan_json(plan));
    const PlanFacts facts = facts_of(plan, 1);
    add(plan_json(plan, facts));
  }
  const size_t right = files.size();
  // Any member that is missing, more, or of another type shows.
  const Json whole = plan_json(sample_plans().front());
  for (const auto& [key, value] : whole.items()) {
    Json less = whole;
    less.erase(key);
    add(less);
    Json other = whole;
    other[key] = value.is_object() ? Json(7) : Json::object({{"more", Json::array({1})}});
    add(other);
  }
  Json more = whole;
  more["steps"][0]["more"] = 1;
  add(more);
  const std::vector<std::string> answers = folder.check(folder.write("schema", plan_schema().dump()), files);
  for (size_t i = 0; i < files.size(); ++i)
    EXPECT_EQ(answers[i], i < right ? "yes" : "no") << read_text_file(files[i]).substr(0, 2000);
  EXPECT_GT(right, 30U);
}

size_t barrier_count(const Plan& plan) {
  size_t count =
      plan.prologue_barriers.size() + plan.once_barriers.size() + plan.frame_start.size() + plan.inputs_ready.size();
  const auto add = [&](const std::vector<Observation>& list) {
    for (const Observation& observation : list) count += observation.barriers.size();
  };
  add(plan.opening_observations);
  for (const auto* steps : {&plan.once, &plan.steps})
    for (const PlanStep& step : *steps) {
      count += step.barriers.size();
      add(step.observations);
    }
  return count;
}

TEST(PlanJson, HasEveryBarrierAndItsAccesses) {
  for (Plan& plan : sample_plans()) {
    const PlanFacts facts = facts_of(plan, 2);
    const Json json = plan_json(plan, facts);
    size_t found = 0;
    const Json flat = json.flatten();
    for (const auto& [path, value] : flat.items()) {
      if (path.ends_with("/takes_over")) ++found;
      if (path.ends_with("/from") || path.ends_with("/to") || path.ends_with("/access")) {
        EXPECT_TRUE(json["accesses"].contains(value.get<std::string>())) << path;
      }
      if (path.ends_with("/reason")) {
        EXPECT_NE(value.get<std::string>(), "") << path;
      }
    }
    EXPECT_EQ(found, barrier_count(plan));
    EXPECT_GT(found, 0U);
  }
}

/// Two values in the same bytes in the same step would be drawn over one another.
TEST(PlanJson, ValuesThatShareMemoryAreLiveAtDifferentSteps) {
  size_t pairs = 0;
  for (Plan& plan : sample_plans()) {
    const PlanFacts facts = facts_of(plan, 3);
    const Json values = plan_json(plan, facts)["values"];
    for (size_t a = 0; a < values.size(); ++a)
      for (size_t b = 0; b < a; ++b) {
        const Json& one = values[a];
        const Json& other = values[b];
        if (one["place"].is_null() || other["place"].is_null() || one["place"]["heap"] != other["place"]["heap"])
          continue;
        const auto begin = [](const Json& value) { return value["place"]["offset"].get<uint64_t>(); };
        const auto end = [&](const Json& value) { return begin(value) + value["place"]["bytes"].get<uint64_t>(); };
        if (begin(one) >= end(other) || begin(other) >= end(one)) continue;
        ++pairs;
        EXPECT_TRUE(one["last_step"] < other["first_step"] || other["last_step"] < one["first_step"])
            << one["name"] << " " << other["name"];
        EXPECT_EQ(one["kept"], "frame");
      }
  }
  EXPECT_GT(pairs, 20U);
}

TEST(PlanJson, SaysHowLongValuesMatter) {
  const Plan plan = toy::plan_of(toy::file(
      R"("s": {"type": "source"}, "q": {"type": "still"}, "f": {"type": "filter", "in": {"x": "s.a", "y": "q.a"}},
         "p": {"type": "patch", "in": {"x": "f.a"}}, "b": {"type": "black", "enabled": false, "in": {"x": "s.a"}},
         "m": {"type": "mix", "in": {"x": "p.a", "y": "f.a@2"}}, "n": {"type": "mix", "in": {"x": "m.a", "y": "b.a"}})",
      R"("o": "n.a")"));
  std::map<std::string, std::string> kept;
  std::map<std::string, std::string> steps;
  const Json json = plan_json(plan);
  for (const Json& value : json["values"]) {
    kept[value["name"]] = value["kept"];
    steps[value["name"]] = value["first_step"].dump() + ".." + value["last_step"].dump();
  }
  EXPECT_EQ(kept["s.a"], "frame");
  EXPECT_EQ(kept["q.a"], "once");
  EXPECT_EQ(kept["f.a"], "history");
  EXPECT_EQ(kept["p.a"], "persistent");
  EXPECT_EQ(kept["b.a"], "constant");
  ASSERT_EQ(plan.steps.size(), 5U) << "s, f, p, m, n";
  EXPECT_EQ(steps["s.a"], "0..1");
  EXPECT_EQ(steps["q.a"], "1..1");
  EXPECT_EQ(steps["f.a"], "1..3");
  EXPECT_EQ(steps["b.a"], "4..4");
  EXPECT_EQ(steps["n.a"], "4..4");
}

/// Longest chain by trying every way back through the plan's JSON: shares nothing with critical_path.
double longest_to(const Json& plan, size_t step, const std::vector<double>& times) {
  double before = 0;
  for (const Json& input : plan["steps"][step]["inputs"])
    for (size_t other = 0; other < plan["steps"].size(); ++other)
      for (const Json& output : plan["steps"][other]["outputs"])
        if (input["first_age"] == 0 && output["value"] == input["value"])
          before = std::max(before, longest_to(plan, other, times));
  return before + times[step];
}

TEST(CriticalPath, IsTheLongestChain) {
  for (uint32_t seed = 0; seed < 40; ++seed) {
    Plan plan = toy::plan_of(toy::random_graph(seed, 9));
    const std::vector<double> times = facts_of(plan, seed).times->step_ms;
    const Json json = plan_json(plan);
    double longest = 0;
    double sum = 0;
    for (size_t step = 0; step < times.size(); ++step) {
      longest = std::max(longest, longest_to(json, step, times));
      sum += times[step];
    }
    const CriticalPath path = critical_path(plan, times);
    EXPECT_NEAR(path.length_ms, longest, 1e-9);
    EXPECT_NEAR(path.sum_ms, sum, 1e-9);
    // The steps named are a chain of that length, and none begins before those it waits for have ended.
    double chain = 0;
    const auto before = steps_before(plan);
    for (size_t i = 0; i < path.steps.size(); ++i) {
      EXPECT_NEAR(path.earliest_ms[path.steps[i]], chain, 1e-9);
      chain += times[path.steps[i]];
      if (i > 0) {
        EXPECT_NE(std::count(before[path.steps[i]].begin(), before[path.steps[i]].end(), path.steps[i - 1]), 0);
      }
    }
    EXPECT_NEAR(chain, longest, 1e-9);
    for (size_t step = 0; step < times.size(); ++step)
      for (const uint32_t earlier : before[step])
        EXPECT_GE(path.earliest_ms[step] + 1e-9, path.earliest_ms[earlier] + times[earlier]);
  }
}

TEST(CriticalPath, ClosedForms) {
  // A chain: all of it. Histories do not chain within a frame.
  const Plan chain = toy::plan_of(toy::file(R"("a": {"type": "source"}, "b": {"type": "filter", "in": {"x": "a.a"}},
                                               "c": {"type": "filter", "in": {"x": "b.a", "y": "d.a@1"}},
                                               "d": {"type": "filter", "in": {"x": "c.a"}})",
                                            R"("o": "d.a")"));
  const CriticalPath whole = critical_path(chain, std::vector<double>{1, 2, 4, 8});
  EXPECT_EQ(whole.length_ms, 15);
  EXPECT_EQ(whole.sum_ms, 15);
  EXPECT_EQ(whole.steps, (std::vector<uint32_t>{0, 1, 2, 3}));
  // Two that need nothing of one another, and one that needs both.
  const Plan fork = toy::plan_of(toy::file(
      R"("a": {"type": "source"}, "b": {"type": "source"}, "c": {"type": "mix", "in": {"x": "a.a", "y": "b.a"}})",
      R"("o": "c.a")"));
  const CriticalPath shorter = critical_path(fork, std::vector<double>{3, 5, 1});
  EXPECT_EQ(shorter.length_ms, 6);
  EXPECT_EQ(shorter.sum_ms, 9);
  EXPECT_EQ(shorter.steps, (std::vector<uint32_t>{1, 2}));
  const std::string text = print_critical_path(fork, std::vector<double>{3, 5, 1});
  EXPECT_NE(text.find("critical path 6.00 ms of 9.00 ms: overlapping passes can save at most 3.00 ms (33.3 %)"),
            std::string::npos)
      << text;
  EXPECT_EQ(critical_path(Plan{}, {}).length_ms, 0);
}

}  // namespace
}  // namespace lightloom
