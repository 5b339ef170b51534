#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "framework/cli/bench_report.hpp"
#include "tests/cli/program_fixture.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::cli {
namespace {

using ::testing::HasSubstr;

class BenchCommand : public ProgramTest {
 protected:
  int bench(std::vector<std::string> more) {
    std::vector<std::string> arguments = {"bench",     (source_dir() / "graphs/paper.json").string(),
                                          "--scene",   (source_dir() / "samples/scenes/atrium.scene.json").string(),
                                          "--size",    "16x12",
                                          "--set",     "resolution=16",
                                          "--frames",  "0..6",
                                          "--warm-up", "1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
};

TEST_F(BenchCommand, MeasuresTwoRunsBesideEachOther) {
  ASSERT_EQ(bench({"--disable", "denoise_*", "--json", "--count-rays",
                   "--against=--size 16x12 --set resolution=16 --variant raw"}),
            0)
      << err_;
  const nlohmann::json json = nlohmann::json::parse(out_);
  for (const nlohmann::json& run : {json, json["against"]}) {
    EXPECT_EQ(run["frame_ms"]["samples"].size(), 7u);
    EXPECT_GT(run["frame_ms"]["median"], 0.0);
    EXPECT_GE(run["frame_ms"]["p95"], run["frame_ms"]["median"]);
    EXPECT_EQ(run["passes"]["trace"]["samples"].size(), 7u);
    EXPECT_GT(run["rays"]["rays_per_second"], 0.0);
    EXPECT_GT(run["once"]["first_frame_ms"], 0.0);
    EXPECT_GT(run["value_memory_bytes"], 0);
  }
  EXPECT_GT(json["host_peak_bytes"], 0);
  EXPECT_EQ(json["comparison"]["frame"]["pairs"], 7);
  EXPECT_TRUE(json["comparison"]["passes"].contains("trace"));
  EXPECT_FALSE(json["comparison"]["passes"].contains("temporal")) << "the second run has none";
}

TEST(BenchReport, IsATableOfPassesWithWhatIsSpentOnce) {
  study::BenchRecord record;
  record.device.name = "made-up device";
  record.settings = {.first_frame = 0, .frames = 2, .warm_up = 3};
  study::BenchFigures run;
  run.name = "x.json";
  run.frame_ms = {10, 12};
  run.passes = {"trace", "tonemap"};
  run.pass_ms = {{8, 9}, {1, 1}};
  run.rays = study::RayCounts{{"trace"}, 1000, 5000};
  record.runs = {run};
  record.plans = {Plan{}};
  const std::string text = bench_report(record);
  EXPECT_THAT(text, HasSubstr("made-up device, ; 2 frames after 3 to warm up"));
  EXPECT_THAT(text, HasSubstr("whole frame             11      11.9"));
  EXPECT_THAT(text, HasSubstr("passes alone, together  9.5     9.95"));
  EXPECT_THAT(text, HasSubstr("  trace                 8.5     8.95"));
  EXPECT_THAT(text, HasSubstr("1000 rays a frame, 5000 steps (5 a ray); 0.118 million rays"));
  EXPECT_THAT(text, HasSubstr("first frame, pipelines made"));
}

TEST_F(BenchCommand, MistakesInTheSecondRunAreMistakesOfUsage) {
  EXPECT_EQ(bench({"--against", "graphs/paper.json --nope"}), 2);
  EXPECT_THAT(err_, HasSubstr("option '--against': '--against' has no option '--nope'"));
  EXPECT_EQ(bench({"--against", "not_there.json"}), 3);
  EXPECT_THAT(err_, HasSubstr("not_there.json"));
}

}  // namespace
}  // namespace lightloom::cli
