#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <memory>
#include <set>

#include "framework/base/error.hpp"
#include "framework/stability/results.hpp"
#include "framework/stability/run_checks.hpp"
#include "passes/registry.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::stability {

/// How test lists name a check.
static void PrintTo(const Check& check, std::ostream* out) {
  *out << check.extreme;
}

namespace {

Lab& shared_lab() {
  static const std::unique_ptr<PassRegistry> registry = [] {
    auto made = std::make_unique<PassRegistry>();
    passes::register_builtin_passes(*made);
    return made;
  }();
  static Lab lab(test::shared_device(), *registry, run::default_shader_folders());
  return lab;
}

std::vector<Check> checks_that_are(bool slow) {
  std::vector<Check> chosen;
  for (const Check& check : all_checks())
    if (check.slow == slow) chosen.push_back(check);
  return chosen;
}

class Stability : public ::testing::TestWithParam<Check> {};

TEST_P(Stability, KeepsItsBounds) {
  const Outcome outcome = run_check(GetParam(), shared_lab());
  for (const Figure& figure : outcome.figures) {
    std::cout << "  " << figure.what << ": " << figure_text(figure) << '\n';
    EXPECT_TRUE(holds(figure)) << figure.what << ": " << figure_text(figure);
  }
  EXPECT_EQ(outcome.failure, "");
  EXPECT_TRUE(passed(outcome));
}

std::string name_of(const ::testing::TestParamInfo<Check>& info) {
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(Everyday, Stability, ::testing::ValuesIn(checks_that_are(false)), name_of);
INSTANTIATE_TEST_SUITE_P(Slow, Stability, ::testing::ValuesIn(checks_that_are(true)), name_of);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Stability);

TEST(StabilityChecks, SayWhatTheyAreAbout) {
  std::set<std::string> names;
  for (const Check& check : all_checks()) {
    EXPECT_TRUE(names.insert(check.name).second) << check.name << " twice";
    EXPECT_FALSE(check.group.empty() || check.extreme.empty() || check.danger.empty() || check.guard.empty())
        << check.name;
  }
}

TEST(StabilityChecks, OfOneGroupStandTogether) {
  std::set<std::string> seen;
  std::string last;
  for (const Check& check : all_checks()) {
    if (check.group != last) {
      EXPECT_TRUE(seen.insert(check.group).second) << check.group << " again at " << check.name;
    }
    last = check.group;
  }
}

TEST(StabilityChecks, AFigureThatIsNoNumberNeverHolds) {
  for (const Relation relation : {Relation::at_most, Relation::at_least, Relation::equal})
    EXPECT_FALSE(holds({"x", std::nan(""), relation, 1, ""}));
  EXPECT_TRUE(holds(at_most("x", 1, 1)));
  EXPECT_FALSE(holds(at_most("x", 1.0001, 1)));
  EXPECT_TRUE(holds(at_least("x", 1, 1)));
  EXPECT_FALSE(holds(at_least("x", 0.9999, 1)));
  EXPECT_TRUE(holds(none("x", 0)));
  EXPECT_FALSE(holds(none("x", 1)));
}

Check made_up(std::function<std::vector<Figure>(Lab&)> measure) {
  return {.name = "made_up", .group = "g", .extreme = "e", .danger = "d", .guard = "w", .measure = std::move(measure)};
}

TEST(StabilityChecks, MissedBoundsErrorsAndNothingMeasuredFail) {
  Lab& lab = shared_lab();
  EXPECT_TRUE(passed(run_check(made_up([](Lab&) { return std::vector{none("x", 0)}; }), lab)));
  EXPECT_FALSE(passed(run_check(made_up([](Lab&) { return std::vector{none("x", 1)}; }), lab)));
  EXPECT_FALSE(passed(run_check(made_up([](Lab&) { return std::vector<Figure>{}; }), lab)));
  const Outcome thrown =
      run_check(made_up([](Lab&) -> std::vector<Figure> { throw Error(ExitCode::run_failed, "no room"); }), lab);
  EXPECT_FALSE(passed(thrown));
  EXPECT_EQ(thrown.failure, "no room");
}

TEST(StabilityChecks, AreChosenByNameAndGroup) {
  std::vector<Check> checks(3, made_up({}));
  checks[1].name = "other";
  checks[2].name = "long";
  checks[2].slow = true;
  EXPECT_EQ(choose_checks(checks, {}, false).size(), 2u);
  EXPECT_EQ(choose_checks(checks, {}, true).size(), 3u);
  EXPECT_EQ(choose_checks(checks, {"g"}, false).size(), 2u);
  EXPECT_EQ(choose_checks(checks, {"long"}, false).size(), 1u);
  EXPECT_EQ(choose_checks(checks, {"ot*"}, false).front()->name, "other");
  try {
    (void)choose_checks(checks, {"othr"}, false);
    ADD_FAILURE() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_EQ(error.hint(), "did you mean 'other'?");
  }
}

TEST(StabilityResults, AreTextMarkdownAndJson) {
  const Check check = made_up({});
  const std::vector<Outcome> outcomes = {
      {&check, {at_most("error | relative", 2e-5, 1e-5, "relative"), at_most("none", std::nan(""), 1)}, "", 0.5}};
  gpu::DeviceInfo device;
  device.name = "made-up device";
  device.driver = "driver";
  device.driver_info = "1.2";
  const TableOrigin origin{device, true, "lightloom 9"};
  EXPECT_EQ(figure_text(outcomes[0].figures[0]), "2e-05 <= 1e-05 relative  MISSED");
  const std::string markdown = to_markdown(outcomes, origin);
  EXPECT_NE(
      markdown.find("0 of 1 checks passed, 0 of 2 figures hold.\n\nDevice: made-up device, driver 1.2; validation"),
      std::string::npos)
      << markdown;
  EXPECT_NE(markdown.find("| `made_up` | error \\| relative | 2e-05 | <= 1e-05 | relative | **no** |"),
            std::string::npos)
      << markdown;
  const nlohmann::ordered_json json = to_json(outcomes, origin);
  EXPECT_FALSE(json["passed"]);
  EXPECT_TRUE(json["checks"][0]["figures"][1]["value"].is_null());
  EXPECT_EQ(json["checks"][0]["figures"][0]["threshold"], 1e-5);
  const std::string html = to_html(outcomes, origin);
  EXPECT_EQ(html.find("{{"), std::string::npos);
  EXPECT_NE(html.find("<tr class=\"missed\"><td>error | relative</td><td class=\"number\">2e-05</td>"),
            std::string::npos)
      << html.substr(html.find("<main"));
}

}  // namespace
}  // namespace lightloom::stability
