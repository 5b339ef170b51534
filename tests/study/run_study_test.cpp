// Studies end to end, small: what they render, keep, judge and say.
#include "framework/study/run_study.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "framework/base/error.hpp"
#include "framework/image/exr.hpp"
#include "framework/study/judge.hpp"
#include "framework/study/mean_image.hpp"
#include "framework/study/tonemap.hpp"
#include "tests/study/study_fixture.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/graph_runner.hpp"

namespace lightloom::test {
namespace {

using nlohmann::ordered_json;
using study::Row;
using study::StudyResults;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST_F(StudyTest, AnAblationNamesWhatIsGoneAndKeepsTheRest) {
  const StudyResults results = run(small_study({{"ablate", {"denoise_box_?", "gather"}}, {"seeds", 2}}));
  ASSERT_EQ(results.rows.size(), 4U);
  const Row& full = results.rows.front();
  EXPECT_EQ(full.setting, "full");
  EXPECT_TRUE(full.verdicts.empty());
  EXPECT_TRUE(full.error.empty()) << full.error;
  const Row& without = row_of(results, "without denoise_box_x");
  EXPECT_THAT(without.disabled, ElementsAre("denoise_box_x"));
  EXPECT_TRUE(without.culled.empty());
  EXPECT_EQ(without.passes.size() + 1, full.passes.size());
  EXPECT_LE(without.memory_bytes, full.memory_bytes);
  EXPECT_EQ(without.metrics.at("flip").count, 2U);
  EXPECT_TRUE(without.verdicts.contains("flip"));
  EXPECT_TRUE(without.verdicts.contains("frame_ms"));
  EXPECT_THAT(row_of(results, "without gather").error, HasSubstr("which nothing can replace"))
      << "the row says why, and the others go on";
  for (const std::filesystem::path& picture : {full.picture, full.heat_map, results.views[0].reference})
    EXPECT_TRUE(std::filesystem::is_regular_file(folder_ / "out" / picture)) << picture;
  EXPECT_GT(results.views[0].reference_relmse, 0) << "the reference says how noisy it is";
  EXPECT_EQ(results.graph_passes.size(), full.passes.size());
}

TEST_F(StudyTest, ASwapSaysWhatWasCulledWithIt) {
  const StudyResults results = run(small_study(
      {{"variants", {{{"name", "voxels"}}, {{"name", "truth"}, {"swap", {{"trace", "reference_path_trace"}}}}}}}));
  const Row& truth = row_of(results, "truth");
  EXPECT_TRUE(truth.error.empty()) << truth.error;
  EXPECT_TRUE(truth.disabled.empty());
  EXPECT_THAT(truth.culled, ::testing::IsSupersetOf({"voxelize_static", "distance"}));
}

TEST_F(StudyTest, FinishedCellsAreNeverRenderedAgain) {
  const ordered_json study = small_study({{"sweep", {{"paths", {1, 2}}}}});
  (void)run(study);
  EXPECT_EQ(rendered_, 3U) << "two cells and a reference";
  const StudyResults again = run(study);
  EXPECT_EQ(rendered_, 0U);
  EXPECT_EQ(again.rows[1].metrics.at("flip").count, 1U);
  (void)run(small_study({{"sweep", {{"paths", {1, 2, 3}}}}, {"name", "other"}, {"metrics", {"mse"}}}));
  EXPECT_EQ(rendered_, 1U) << "what is new alone";
  (void)run(small_study({{"sweep", {{"paths", {2, 1}}}}, {"seeds", {0, 5}}}));
  EXPECT_EQ(rendered_, 2U) << "the new seed of both";
  std::filesystem::remove_all(folder_ / "out/references");
  (void)run(study);
  EXPECT_EQ(rendered_, 1U) << "a reference that is made again is the same, and so is its judgement";
}

TEST_F(StudyTest, ProgressCountsWhatIsDoneAndKnowsTheTimeLeft) {
  const gpu::DeviceInfo device = gpu::Device().info();
  Diagnostics diagnostics;
  const auto plan = study::plan_study(spec_of(small_study({{"seeds", 3}})), {registry_, device}, diagnostics);
  const study::StudyFolder kept(folder_ / "out");
  EXPECT_FALSE(study::time_needed(plan.value(), kept).has_value()) << "nothing was done that one could learn from";
  std::vector<study::StudyProgress> seen;
  (void)study::run_study(*plan, kept, {}, [&](const study::StudyProgress& progress) { seen.push_back(progress); });
  ASSERT_FALSE(seen.empty());
  EXPECT_EQ(seen.front().done, 0U);
  EXPECT_FALSE(seen.front().seconds_left.has_value());
  EXPECT_EQ(seen.back().done, 4U);
  EXPECT_EQ(seen.back().total, 4U);
  EXPECT_EQ(seen.back().seconds_left, 0.0);
  for (size_t i = 1; i < seen.size(); ++i) EXPECT_GE(seen[i].done, seen[i - 1].done);
  EXPECT_GT(seen.size(), 8U) << "after each frame, too";
  EXPECT_EQ(study::time_needed(*plan, kept), 0.0);
}

TEST_F(StudyTest, AJobAtATimeOrSeveralGiveTheSame) {
  const ordered_json study = small_study({{"sweep", {{"paths", {1, 2}}, {"bounces", {1, 2}}}}, {"seeds", 2}});
  const StudyResults one = run(study, "one");
  ordered_json parallel = study;
  parallel["jobs"] = 3;
  const StudyResults three = run(parallel, "three");
  EXPECT_EQ(study::results_json(one, study::Times::without), study::results_json(three, study::Times::without));
  EXPECT_FALSE(one.rows[0].disturbed);
  EXPECT_TRUE(three.rows[0].disturbed);
  EXPECT_THAT(three.notes, ::testing::Contains(study::kDisturbedNote));
}

TEST_F(StudyTest, GeneralIsAnAxisThatChangesTimesAlone) {
  const StudyResults results = run(small_study({{"sweep", {{"general", {false, true}}}}}));
  ASSERT_EQ(results.rows.size(), 2U);
  EXPECT_EQ(results.rows[1].setting, "general=true");
  for (const auto& [metric, value] : results.rows[0].metrics)
    EXPECT_EQ(value.mean, results.rows[1].metrics.at(metric).mean) << metric;
  EXPECT_GT(results.rows[0].once_ms, 0);
  EXPECT_EQ(results.rows[1].once_ms, 0) << "nothing is hoisted";
  EXPECT_THAT(results.rows[1].command, ::testing::Contains("--general"));
}

TEST_F(StudyTest, SizesHaveReferencesOfTheirOwnAndMatchedParamsToo) {
  ordered_json reference = {
      {"graph", (source_dir() / "graphs/reference.json").string()}, {"set", {{"paths", 2}}}, {"match", {"bounces"}}};
  (void)run(small_study({{"sweep", {{"size", {"24x18", "48x36"}}, {"bounces", {1, 2}}}},
                         {"mode", "one_at_a_time"},
                         {"reference", reference}}));
  EXPECT_EQ(rendered_, 6U) << "three cells and their references";
}

TEST_F(StudyTest, AnImageIsAReferenceAndEqualsItself) {
  const StudyResults first = run(small_study());
  std::filesystem::path radiance;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / "out/cells"))
    if (entry.path().extension() == ".exr") radiance = entry.path();
  std::filesystem::copy_file(radiance, folder_ / "atrium_0001.exr");
  const StudyResults results = run(small_study({{"reference", {{"image", "{scene}_{frame}.exr"}}}}));
  EXPECT_EQ(results.rows[0].metrics.at("mse").mean, 0);
  EXPECT_EQ(results.rows[0].metrics.at("flip").mean, 0);
  EXPECT_EQ(results.views[0].reference_note, "atrium_0001.exr");
  EXPECT_GT(first.rows[0].metrics.at("mse").mean, 0);
}

TEST_F(StudyTest, ASettingAveragedIsAReferenceThatKnowsItsNoise) {
  const StudyResults results =
      run(small_study({{"seeds", 2},
                       {"variants", {"raw"}},
                       {"reference", {{"setting", {{"variants", {"raw"}}}}, {"frames", 3}, {"average", true}}}}));
  EXPECT_GT(results.views[0].reference_relmse, 0);
  EXPECT_THAT(results.views[0].reference_note, HasSubstr("mean of 3 frames"));
  EXPECT_TRUE(std::isfinite(results.rows[0].metrics.at("relmse").mean));
}

TEST_F(StudyTest, AReferenceOfAnotherSizeIsAProblemOfItsRows) {
  (void)run(small_study());
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / "out/cells"))
    if (entry.path().extension() == ".exr") std::filesystem::copy_file(entry.path(), folder_ / "large.exr");
  const StudyResults results =
      run(small_study({{"sweep", {{"size", {"48x36", "24x18"}}}}, {"reference", {{"image", "large.exr"}}}}));
  EXPECT_EQ(results.rows[0].error, "");
  EXPECT_THAT(results.rows[1].error, HasSubstr("24x18"));
  EXPECT_THROW((void)run(small_study({{"reference", {{"image", "missing.exr"}}}})), Error);
}

TEST_F(StudyTest, MistakesInSettingsPointAtTheStudy) {
  const gpu::DeviceInfo device = gpu::Device().info();
  const std::string text = small_study().dump();
  Diagnostics diagnostics;
  const auto spec = study::parse_study(text.substr(0, text.size() - 1) + ",\n\"sweep\": {\"paths\": [1,\n \"many\"]}}",
                                       "study.json", diagnostics);
  EXPECT_FALSE(study::plan_study(spec.value(), {registry_, device}, diagnostics).has_value());
  ASSERT_FALSE(diagnostics.all().empty());
  EXPECT_EQ(diagnostics.all()[0].where, (SourceLocation{"study.json", 3, 2}));
  EXPECT_THAT(diagnostics.all()[0].message, HasSubstr("setting 'paths=many'"));
}

TEST_F(StudyTest, OneProgramHasTheFolder) {
  const study::StudyFolder held(folder_ / "out");
  try {
    const study::StudyFolder second(folder_ / "out");
    FAIL() << "two at once";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("another study is running"));
    EXPECT_EQ(error.code(), ExitCode::run_failed);
  }
}

TEST_F(StudyTest, DamagedCellsAreRenderedAgain) {
  (void)run(small_study());
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / "out/cells"))
    if (entry.path().filename() == "cell.json") std::ofstream(entry.path()) << "{\"frame_numbers\": 3";
  const StudyResults again = run(small_study());
  EXPECT_EQ(rendered_, 1U);
  EXPECT_TRUE(again.rows[0].error.empty()) << again.rows[0].error;
}

using StudyPictures = DeviceTest;

// The host's tone map against the shader, which shares no code with it.
TEST_F(StudyPictures, AreShownAsTheTonemapPassShowsThem) {
  nlohmann::ordered_json graph = nlohmann::ordered_json::parse(read_text_file(source_dir() / "graphs/paper.json"));
  graph["view"] = {{"width", 40}, {"height", 30}};
  graph["trace"] = graph["view"];
  graph["params"]["resolution"] = 16;
  for (const char* curve : {"filmic", "reinhard", "linear"}) {
    GraphRunOptions options;
    options.link.sets = {{"tonemap.curve", curve}, {"exposure", "0.75"}};
    const Images images =
        run_graph(graph.dump(), scene::load_scene(source_dir() / "samples/scenes/atrium.scene.json"), options).back();
    const image::HostImage shown = study::tone_map(images.at("radiance"), {0.75, curve});
    ASSERT_EQ(shown.texels.size(), images.at("image").texels.size());
    int largest = 0;
    for (size_t i = 0; i < shown.texels.size(); ++i)
      largest = std::max(largest,
                         std::abs(static_cast<int>(shown.texels[i]) - static_cast<int>(images.at("image").texels[i])));
    EXPECT_LE(largest, 1) << curve;
  }
}

image::HostImage flat(std::vector<float> rgba) {
  image::HostImage image{{Format::rgba32_sfloat, Dimension::d2, {static_cast<uint32_t>(rgba.size() / 4), 1, 1}}, {}};
  image.texels.resize(rgba.size() * sizeof(float));
  std::memcpy(image.texels.data(), rgba.data(), image.texels.size());
  return image;
}

TEST(MeanImage, KnowsItsOwnNoise) {
  study::MeanImage mean;
  EXPECT_EQ(mean.relative_noise(0.01), 0);
  for (const float value : {1.0F, 2.0F, 3.0F}) mean.add(flat({value, value, value, 1}));
  EXPECT_DOUBLE_EQ(mean.mean().at(0, 0, 0, 1), 2);
  EXPECT_NEAR(mean.relative_noise(0.01), 1.0 / 3 / (4 + 0.01), 1e-12) << "variance 1 of three images, mean 2";
  EXPECT_NEAR(study::relative_noise(flat({2, 2, 2, 1}), flat({0.5F, 0.5F, 0.5F, 1}), 0.01), 0.25 / 4.01, 1e-9);
}

TEST(ErrorProducts, LeaveOutWhatIsNotFinite) {
  const image::HostImage reference = flat({1, 1, 1, 1, 5, 5, 5, 1});
  const std::vector<double> products =
      study::error_products(reference, {flat({2, 2, 2, 1, 5, NAN, 5, 1}), flat({4, 4, 4, 1, 9, 9, 9, 1})});
  EXPECT_THAT(products, ElementsAre(1, 3, 3, 9));
}

}  // namespace
}  // namespace lightloom::test
