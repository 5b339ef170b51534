#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "framework/cli/bench_report.hpp"
#include "tests/cli/program_fixture.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

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
  ASSERT_EQ(bench({"--disable", "denoise_*", "--json", "--floors",
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
    EXPECT_GT(run["once"]["pipelines_ms"], 0.0);
    EXPECT_GT(run["once"]["shaders_ms"], 0.0);
    EXPECT_LT(run["once"]["pipelines_ms"].get<double>() + run["once"]["shaders_ms"].get<double>(),
              run["once"]["first_frame_ms"]);
    EXPECT_GT(run["value_memory_bytes"], 0);
    EXPECT_GE(run["device_bytes"]["total"], run["value_memory_bytes"]);
    for (const char* purpose : {"images", "buffers", "shared", "staging"})
      EXPECT_GT(run["device_bytes"][purpose], 0) << purpose;
    EXPECT_GT(run["floors"]["trace"]["steps_ms"], 0.0) << "where floors are wanted, rays are counted";
    EXPECT_EQ(run["floors"]["tonemap"]["bytes_written"], 16 * 12 * 4);
    EXPECT_EQ(run["floors"]["tonemap"]["measured_ms"], run["passes"]["tonemap"]["median"]);
  }
  EXPECT_GE(json["device_peak_bytes"]["total"], json["device_bytes"]["total"]);
  EXPECT_GT(json["device_rates"]["copy_bytes_per_second"]["transfer"], 0.0);
  EXPECT_GT(json["host_bytes"], 0);
  EXPECT_GE(json["host_peak_bytes"], json["host_bytes"]);
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
  run.once = {{"voxelize", 7}};
  run.memory.of = {2 << 20, 1 << 20, 0, 0};
  record.memory.device_peak_total = 4 << 20;
  record.runs = {run};
  record.plans = {Plan{}};
  const std::string text = bench_report(record);
  EXPECT_THAT(text, HasSubstr("made-up device, ; 2 frames after 3 to warm up"));
  EXPECT_THAT(text, HasSubstr("whole frame             11      11.9"));
  EXPECT_THAT(text, HasSubstr("passes alone, together  9.5     9.95"));
  EXPECT_THAT(text, HasSubstr("  trace                 8.5     8.95"));
  EXPECT_THAT(text, HasSubstr("1000 rays a frame, 5000 steps (5 a ray); 0.118 million rays"));
  EXPECT_THAT(text, HasSubstr("pipelines made"));
  EXPECT_THAT(text, HasSubstr("    voxelize, hoisted              7"));
  EXPECT_THAT(text, HasSubstr("  device                   3    4"));
  EXPECT_THAT(text, Not(HasSubstr("near the limit")));
}

TEST(BenchReport, SaysWhyADifferenceIsNone) {
  study::BenchRecord record;
  study::BenchFigures run;
  run.passes = {"trace"};
  record.plans = {Plan{}, Plan{}};
  const auto report = [&](const std::vector<double>& first, const std::vector<double>& second) {
    record.settings.frames = static_cast<uint32_t>(first.size());
    record.runs = {run, run};
    record.runs[0].frame_ms = first;
    record.runs[0].pass_ms = {first};
    record.runs[1].frame_ms = second;
    record.runs[1].pass_ms = {second};
    return bench_report(record);
  };
  EXPECT_THAT(report({10, 12}, {5, 6}), HasSubstr("too few frames to tell"));
  EXPECT_THAT(report({10, 12}, {12, 10}), HasSubstr("within the noise"));
  const std::string clear = report({10, 10, 10, 10, 10, 10}, {5, 5, 5, 5, 5, 5});
  EXPECT_THAT(clear, HasSubstr("whole frame"));
  EXPECT_THAT(clear, Not(HasSubstr("too few frames")));
  EXPECT_THAT(clear, Not(HasSubstr("within the noise")));
}

TEST(BenchReport, SetsFloorsBesideWhatWasMeasured) {
  study::BenchRecord record;
  study::BenchFigures run;
  run.frame_ms = {10};
  record.runs = {run};
  record.plans = {Plan{}};
  record.rates.emplace().copy = {.in_cache = 4e9, .in_memory = 2e9, .transfer = 1e9};
  record.floors = {{{.pass = "trace",
                     .bytes_read = 1'500'000,
                     .bytes_written = 500'000,
                     .bytes_ms = 1,
                     .texels_ms = 2,
                     .steps_ms = 4,
                     .measured_ms = 8},
                    {.pass = "tonemap", .bytes_ms = 0.5, .texels_ms = 1, .measured_ms = 1}}};
  const std::string text = bench_report(record);
  EXPECT_THAT(text, HasSubstr("in cache 4  in memory 2  by transfer 1"));
  EXPECT_THAT(text, HasSubstr("  trace    2   1         2          4         4      8         2"));
  EXPECT_THAT(text, HasSubstr("  tonemap  0   0.5       1          -         1      1         1"));
  EXPECT_THAT(text, HasSubstr("  all                                         5      9         1.8"));
}

TEST_F(BenchCommand, MistakesInTheSecondRunAreMistakesOfUsage) {
  EXPECT_EQ(bench({"--against", "graphs/paper.json --nope"}), 2);
  EXPECT_THAT(err_, HasSubstr("option '--against': '--against' has no option '--nope'"));
  EXPECT_EQ(bench({"--against", "not_there.json"}), 3);
  EXPECT_THAT(err_, HasSubstr("not_there.json"));
}

}  // namespace
}  // namespace lightloom::cli
