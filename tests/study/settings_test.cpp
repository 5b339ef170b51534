#include "framework/study/settings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace lightloom::study {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

StudySpec spec_of(const std::string& members) {
  Diagnostics diagnostics;
  auto spec = parse_study(R"({"lightloom_study": 1, "graph": "g.json", "scenes": ["s.gltf"])" +
                              (members.empty() ? "" : ", " + members) + "}",
                          "study.json", diagnostics);
  for (const Diagnostic& problem : diagnostics.all()) ADD_FAILURE() << format_diagnostic(problem);
  return spec.value();
}

const std::vector<std::string> kPasses = {"trace", "temporal", "denoise_x", "denoise_y"};

std::vector<std::string> names(const std::string& members) {
  Diagnostics diagnostics;
  const auto settings = expand_settings(spec_of(members), kPasses, diagnostics);
  std::vector<std::string> list;
  if (settings)
    for (const Setting& setting : settings->list) list.push_back(setting.name);
  return list;
}

TEST(Settings, NothingToCompareIsTheGraphItself) {
  EXPECT_THAT(names(""), ElementsAre("full"));
}

TEST(Settings, ASweepCrossesItsAxes) {
  EXPECT_THAT(
      names(R"("sweep": {"paths": [1, 2], "denoise": {"on": {}, "off": {}}})"),
      ElementsAre("paths=1, denoise=on", "paths=1, denoise=off", "paths=2, denoise=on", "paths=2, denoise=off"));
}

TEST(Settings, OneAtATimeKeepsTheOthersAtTheirFirstValue) {
  EXPECT_THAT(names(R"("mode": "one_at_a_time", "sweep": {"paths": [1, 2, 3], "radius": [4, 8]})"),
              ElementsAre("paths=1, radius=4", "paths=2, radius=4", "paths=3, radius=4", "paths=1, radius=8"));
}

TEST(Settings, AblationSwitchesEachPassOffAlone) {
  EXPECT_THAT(names(R"("ablate": ["denoise_*", "temporal"])"),
              ElementsAre("full", "without temporal", "without denoise_x", "without denoise_y"));
  EXPECT_THAT(names(R"("ablate": ["temporal"], "variants": ["raw"], "sweep": {"paths": [1, 2]})"),
              ElementsAre("full, paths=1", "full, paths=2", "without temporal, paths=1", "without temporal, paths=2",
                          "raw, paths=1", "raw, paths=2"));
}

TEST(Settings, FactorialIsEveryCombination) {
  Diagnostics diagnostics;
  const auto settings =
      expand_settings(spec_of(R"("ablate": ["denoise_*", "temporal"], "factorial": true)"), kPasses, diagnostics);
  ASSERT_TRUE(settings.has_value());
  EXPECT_THAT(settings->axes, ElementsAre("temporal", "denoise_x", "denoise_y"));
  ASSERT_EQ(settings->list.size(), 8U);
  std::set<std::vector<std::string>> combinations;
  for (const Setting& setting : settings->list) combinations.insert(setting.changes.disables);
  EXPECT_EQ(combinations.size(), 8U);
  EXPECT_TRUE(settings->list.front().changes.disables.empty()) << "the baseline comes first";
  EXPECT_EQ(settings->list.back().name, "without temporal and denoise_x and denoise_y");
}

TEST(Settings, TooManyCombinationsAreRefusedAtOnce) {
  std::vector<std::string> passes;
  for (int i = 0; i < 60; ++i) passes.push_back("p" + std::to_string(i));
  Diagnostics diagnostics;
  EXPECT_FALSE(expand_settings(spec_of(R"("ablate": ["p*"], "factorial": true)"), passes, diagnostics).has_value());
  ASSERT_EQ(diagnostics.all().size(), 1U);
  EXPECT_EQ(diagnostics.all()[0].code, "too-many-settings");
  EXPECT_THAT(diagnostics.all()[0].hint, HasSubstr("2^60"));
  passes.resize(10);
  Diagnostics enough;
  EXPECT_EQ(expand_settings(spec_of(R"("ablate": ["p*"], "factorial": true)"), passes, enough)->list.size(), 1024U);
}

TEST(Settings, AGlobMustMatchAPassThatRuns) {
  Diagnostics diagnostics;
  EXPECT_FALSE(expand_settings(spec_of(R"("ablate": ["temporl"])"), kPasses, diagnostics).has_value());
  ASSERT_EQ(diagnostics.all().size(), 1U);
  EXPECT_THAT(diagnostics.all()[0].hint, HasSubstr("temporal"));
  EXPECT_EQ(diagnostics.all()[0].where.line, 1U);
}

TEST(Settings, ChangesComeInOrder) {
  Diagnostics diagnostics;
  const auto settings = expand_settings(
      spec_of(
          R"("variants": [{"name": "a", "set": {"paths": 1}, "size": "8x8"}], "sweep": {"paths": [4], "size": ["9x9"]})"),
      kPasses, diagnostics);
  ASSERT_TRUE(settings.has_value());
  const Changes& changes = settings->list[0].changes;
  EXPECT_EQ(changes.sets.back().second, "4") << "the sweep has the last word";
  EXPECT_EQ(changes.size, (Size{9, 9}));
  EXPECT_THAT(command_options(changes), ElementsAre("--size", "9x9", "--set", "paths=1", "--set", "paths=4"));
}

}  // namespace
}  // namespace lightloom::study
