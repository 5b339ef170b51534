// Passes replayed from the dumps of a run, against the run itself.
#include "framework/run/replay.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>

#include "framework/base/error.hpp"
#include "framework/base/file.hpp"
#include "framework/run/render.hpp"
#include "passes/registry.hpp"
#include "tests/support/run_files.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::run {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using ::testing::HasSubstr;

class ReplayTest : public ::testing::Test {
 protected:
  void SetUp() override {
    passes::register_builtin_passes(registry_);
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ =
        fs::temp_directory_path() / ("lightloom-replay-" + std::to_string(getpid()) + "-" + std::string(test->name()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// Camera and gem move; frames 5 to 8, so that frame numbers are not counts.
  RenderRequest render_request(const std::string& graph, const std::string& out) const {
    RenderRequest made;
    made.graph = graph.starts_with('/') ? fs::path(graph) : source_dir() / "graphs" / graph;
    made.scene = source_dir() / "samples/scenes/atrium.scene.json";
    made.camera_path = source_dir() / "samples/scenes/atrium.path.json";
    made.link.view = {32, 24};
    made.link.trace = {16, 12};
    made.link.sets = {{"resolution", "20"}};
    made.link.captures = {"*"};
    made.seed = 3;
    made.first_frame = 5;
    made.last_frame = 8;
    made.out = folder_ / out;
    return made;
  }

  void render_run(const RenderRequest& wanted) {
    Diagnostics diagnostics;
    RenderSummary summary;
    ASSERT_TRUE(render(wanted, registry_, {}, diagnostics, summary));
    ASSERT_FALSE(diagnostics.has_errors());
  }

  ReplayRequest replay_request(const std::string& run, std::vector<std::string> passes) const {
    ReplayRequest made;
    made.folder = folder_ / run;
    made.passes = std::move(passes);
    made.out = folder_ / "replayed";
    made.device.validate = true;
    return made;
  }

  ReplaySummary replay_run(const ReplayRequest& wanted) {
    Diagnostics diagnostics;
    ReplaySummary summary;
    EXPECT_TRUE(replay(wanted, registry_, diagnostics, summary));
    for (const Diagnostic& diagnostic : diagnostics.all()) ADD_FAILURE() << format_diagnostic(diagnostic);
    for (const std::string& warning : summary.warnings) ADD_FAILURE() << warning;
    return summary;
  }

  void expect_bits(const ReplaySummary& summary) {
    EXPECT_TRUE(summary.compared);
    EXPECT_TRUE(summary.changes.empty()) << summary.changes.front();
    EXPECT_FALSE(summary.values.empty());
    for (const ReplayedValue& value : summary.values) {
      EXPECT_TRUE(value.dumped) << value.name;
      ASSERT_TRUE(value.difference) << value.name;
      EXPECT_EQ(value.difference->texels, 0U) << value.name;
    }
    EXPECT_TRUE(summary.same);
  }

  std::vector<std::string> passes_of(const std::string& run) const {
    const auto record = ordered_json::parse(read_text_file(folder_ / run / "run.json"));
    std::vector<std::string> names;
    for (const char* list : {"hoisted", "passes"})
      for (const ordered_json& pass : record[list]) names.push_back(pass["pass"].get<std::string>());
    return names;
  }

  std::string error_of(const ReplayRequest& wanted, ExitCode code = ExitCode::invalid_input) {
    Diagnostics diagnostics;
    ReplaySummary summary;
    try {
      EXPECT_FALSE(replay(wanted, registry_, diagnostics, summary));
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code);
      EXPECT_FALSE(fs::exists(folder_ / "replayed")) << "nothing half-written is left behind";
      return error.what() + ("\n" + error.hint());
    }
    return {};
  }

  PassRegistry registry_;
  fs::path folder_;
};

TEST_F(ReplayTest, EveryPassOfTheShippedGraphsAlone) {
  for (const char* graph : {"paper.json", "lightloom.json"}) {
    RenderRequest run = render_request(graph, graph);
    run.dump_format = graph == std::string("paper.json") ? DumpFormat::exr : DumpFormat::npy;
    render_run(run);
    const std::vector<std::string> passes = passes_of(graph);
    EXPECT_GE(passes.size(), 12U);
    for (const std::string& pass : passes) {
      SCOPED_TRACE(std::string(graph) + ": " + pass);
      ReplayRequest wanted = replay_request(graph, {pass});
      wanted.device.validate = pass == "trace";  // each device with the layers takes its time
      expect_bits(replay_run(wanted));
    }
  }
}

TEST_F(ReplayTest, PartsOfAGraphInAnyFrameWriteTheFilesOfTheRun) {
  render_run(render_request("paper.json", "run"));
  for (const uint32_t frame : {5U, 7U}) {
    for (const std::vector<std::string>& passes :
         {std::vector<std::string>{"*"}, {"denoise_*"}, {"trace*", "temporal"}, {"merge", "modulate"}}) {
      ReplayRequest wanted = replay_request("run", passes);
      wanted.frame = frame;
      const ReplaySummary summary = replay_run(wanted);
      EXPECT_EQ(summary.frame, frame);
      expect_bits(summary);
      const auto run_files = test::run_files(folder_ / "run");
      size_t images = 0;
      for (const auto& [name, bytes] : test::run_files(wanted.out)) {
        if (name == "dumps/index.json") continue;
        ASSERT_TRUE(run_files.contains(name)) << name;
        EXPECT_EQ(run_files.at(name), bytes) << name;
        images += name.ends_with("frame.json") ? 0 : 1;
      }
      EXPECT_GE(images, summary.values.size());
      fs::remove_all(wanted.out);
    }
  }
}

TEST_F(ReplayTest, RandomPartsOfAGraph) {
  RenderRequest run = render_request("lightloom.json", "run");
  run.link.hoist = false;
  run.dump_format = DumpFormat::npy;
  render_run(run);
  const std::vector<std::string> all = passes_of("run");
  std::mt19937 random(5);
  for (int part = 0; part < 8; ++part) {
    std::vector<std::string> chosen;
    std::sample(all.begin(), all.end(), std::back_inserter(chosen), 2 + part, random);
    SCOPED_TRACE(::testing::PrintToString(chosen));
    ReplayRequest wanted = replay_request("run", chosen);
    wanted.device.validate = part == 7;
    wanted.frame = 5U + random() % 4;
    expect_bits(replay_run(wanted));
  }
}

TEST_F(ReplayTest, RunningPassesAgainTimesThemAndChangesNothing) {
  render_run(render_request("lightloom.json", "run"));
  ReplayRequest wanted = replay_request("run", {"voxelize*", "temporal*"});
  wanted.repeat = 3;
  const ReplaySummary summary = replay_run(wanted);
  expect_bits(summary);
  for (const PassTime& time : summary.times) EXPECT_GT(time.milliseconds, 0) << time.pass;
  const auto record = ordered_json::parse(read_text_file(wanted.out / "run.json"));
  EXPECT_EQ(record["passes"].size(), summary.times.size());
  EXPECT_EQ(record["passes"][0]["frames_ms"].size(), 3U);
}

TEST_F(ReplayTest, AChangedParamGivesWhatARenderWithItGives) {
  RenderRequest run = render_request("paper.json", "run");
  render_run(run);
  RenderRequest changed = render_request("paper.json", "changed");
  changed.link.sets.emplace_back("exposure", "2");
  render_run(changed);
  ReplayRequest wanted = replay_request("run", {"tonemap"});
  wanted.sets = {{"exposure", "2"}};
  wanted.compare = true;
  const ReplaySummary summary = replay_run(wanted);
  EXPECT_EQ(summary.changes, std::vector<std::string>{"--set exposure=2"});
  EXPECT_FALSE(summary.same);
  ASSERT_EQ(summary.values.size(), 1U);
  EXPECT_GT(summary.values[0].difference->texels, 20U);
  const std::string file = "dumps/0008/tonemap.image.exr";
  EXPECT_EQ(read_text_file(wanted.out / file), read_text_file(folder_ / "changed" / file));
  wanted.compare = false;
  EXPECT_FALSE(replay_run(wanted).compared) << "what is changed on purpose is not held against the dump";
}

TEST_F(ReplayTest, AnEditedGraphIsTakenWhereItIsAskedFor) {
  ordered_json graph = ordered_json::parse(read_text_file(source_dir() / "graphs/paper.json"));
  const std::string file = (folder_ / "graph.json").string();
  std::ofstream(file) << graph.dump(1);
  render_run(render_request(file, "run"));
  graph["params"]["bounces"] = 1;
  std::ofstream(file) << graph.dump(1);
  const ReplaySummary as_recorded = replay_run(replay_request("run", {"trace"}));
  expect_bits(as_recorded);
  ASSERT_EQ(as_recorded.notes.size(), 1U);
  EXPECT_THAT(as_recorded.notes[0], HasSubstr("has changed since the run"));
  ReplayRequest wanted = replay_request("run", {"trace"});
  wanted.graph = file;
  wanted.compare = true;
  const ReplaySummary edited = replay_run(wanted);
  EXPECT_FALSE(edited.same);
  ASSERT_EQ(edited.changes.size(), 1U);
  EXPECT_THAT(edited.changes[0], HasSubstr("the graph"));
}

TEST_F(ReplayTest, SaysAllThatIsMissingAndHowToGetIt) {
  RenderRequest run = render_request("paper.json", "run");
  run.link.captures = {"temporal.radiance", "trace_surface.surface.n*", "trace_surface.surface.position"};
  render_run(run);
  const std::string temporal = error_of(replay_request("run", {"temporal"}));
  EXPECT_THAT(temporal, HasSubstr("trace.radiance of the frames 5 to 8; "));
  EXPECT_THAT(temporal, HasSubstr("--dump trace.radiance"));
  EXPECT_THAT(temporal, HasSubstr("--dump trace_surface.surface.id"));
  EXPECT_THAT(temporal, ::testing::Not(HasSubstr("--dump trace_surface.surface.normal")));
  EXPECT_THAT(error_of(replay_request("run", {"merge"})), HasSubstr("voxelize_static.voxels.albedo of frame 8; "));
  EXPECT_THAT(error_of(replay_request("run", {"temporl"}), ExitCode::usage), HasSubstr("did you mean 'temporal'?"));
  EXPECT_THAT(error_of(replay_request("nowhere", {"*"})), HasSubstr("no run.json"));
  ReplayRequest wanted = replay_request("run", {"gather"});
  wanted.frame = 9;
  EXPECT_THAT(error_of(wanted, ExitCode::usage), HasSubstr("from 5 to 8"));
  wanted = replay_request("run", {"gather"});
  wanted.out = wanted.folder;
  EXPECT_THAT(error_of(wanted, ExitCode::usage), HasSubstr("is the run itself"));
  for (const ReplayedValue& value : replay_run(replay_request("run", {"gather"})).values) {
    EXPECT_FALSE(value.dumped) << value.name;
    EXPECT_FALSE(value.difference) << value.name;
  }
}

TEST_F(ReplayTest, RunsWithoutDumpsAndOldRunsAreRefused) {
  RenderRequest run = render_request("paper.json", "run");
  run.link.captures.clear();
  run.last_frame = 5;
  render_run(run);
  EXPECT_THAT(error_of(replay_request("run", {"gather"})), HasSubstr("nothing was dumped"));
  ordered_json record = ordered_json::parse(read_text_file(run.out / "run.json"));
  record.erase("link");
  std::ofstream(run.out / "run.json") << record.dump();
  EXPECT_THAT(error_of(replay_request("run", {"gather"})), HasSubstr("does not say all"));
}

TEST_F(ReplayTest, ASceneThatChangedIsNamed) {
  fs::copy(source_dir() / "samples/scenes", folder_ / "scenes", fs::copy_options::recursive);
  RenderRequest run = render_request("paper.json", "run");
  run.scene = folder_ / "scenes/atrium.scene.json";
  run.last_frame = 5;
  render_run(run);
  std::ofstream(run.scene, std::ios::app) << "\n";
  const ReplaySummary summary = replay_run(replay_request("run", {"gather"}));
  ASSERT_EQ(summary.changes.size(), 1U);
  EXPECT_THAT(summary.changes[0], HasSubstr("the scene"));
  EXPECT_FALSE(summary.compared);
}

}  // namespace
}  // namespace lightloom::run
