// `lightloom study` as a program: killed and resumed, and the commands it gives to reproduce a row.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <random>
#include <thread>

#include "framework/image/exr.hpp"
#include "tests/study/study_fixture.hpp"

extern char** environ;

namespace lightloom::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

class StudyProgram : public StudyTest {
 protected:
  pid_t start(std::vector<std::string> words) const {
    words.insert(words.begin(), LIGHTLOOM_PROGRAM);
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    const std::string log = (folder_ / "log.txt").string();
    posix_spawn_file_actions_addopen(&files, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_adddup2(&files, 1, 2);
    pid_t child = -1;
    EXPECT_EQ(posix_spawn(&child, LIGHTLOOM_PROGRAM, &files, nullptr, argv.data(), environ), 0);
    posix_spawn_file_actions_destroy(&files);
    return child;
  }
  int run_program(const std::vector<std::string>& words) const {
    int status = 0;
    waitpid(start(words), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string log() const { return read_text_file(folder_ / "log.txt"); }

  /// When each finished cell was written.
  std::map<std::string, fs::file_time_type> finished(const std::string& out) const {
    std::map<std::string, fs::file_time_type> times;
    std::error_code none_yet;
    for (const auto& entry : fs::directory_iterator(folder_ / out / "cells", none_yet))
      if (fs::exists(entry.path() / "cell.json"))
        times[entry.path().filename().string()] = fs::last_write_time(entry.path() / "cell.json");
    return times;
  }
};

uint32_t kills() {
  const char* wanted = std::getenv("LIGHTLOOM_STUDY_KILLS");
  return wanted != nullptr ? static_cast<uint32_t>(std::atoi(wanted)) : 3;
}

TEST_F(StudyProgram, KilledAtRandomMomentsItComesToTheSameResults) {
  const std::string study = (folder_ / "study.json").string();
  std::ofstream(study) << small_study({{"ablate", {"denoise_*", "temporal"}}}).dump();
  const auto words = [&](const std::string& out) {
    return std::vector<std::string>{"study", study, "--no-times", "-o", (folder_ / out).string()};
  };
  ASSERT_EQ(run_program(words("whole")), 0) << log();
  ASSERT_EQ(finished("whole").size(), 6U);
  std::mt19937 random(std::random_device{}());
  // Most of a run goes by in this time: some kills meet the beginning, some the rendering, some the end.
  std::uniform_int_distribution<int> milliseconds(20, 1200);
  uint32_t interrupted = 0;
  for (uint32_t kill = 0; kill < kills(); ++kill) {
    const auto before = finished("killed");
    const pid_t child = start(words("killed"));
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds(random)));
    ::kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    interrupted += WIFSIGNALED(status) ? 1 : 0;
    const auto after = finished("killed");
    for (const auto& [cell, time] : before) {
      ASSERT_TRUE(after.contains(cell)) << "lost after kill " << kill;
      EXPECT_EQ(after.at(cell), time) << "rendered again after kill " << kill;
    }
  }
  EXPECT_GT(interrupted, 0U) << "nothing was interrupted: the test shows nothing";
  ASSERT_EQ(run_program(words("killed")), 0) << log();
  EXPECT_EQ(finished("killed").size(), 6U);
  for (const char* file : {"results.csv", "cells.csv", "results.json"})
    EXPECT_EQ(read_text_file(folder_ / "whole" / file), read_text_file(folder_ / "killed" / file)) << file;
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "killed"))
    EXPECT_FALSE(entry.path().filename().string().starts_with(".aside")) << entry.path();
}

TEST_F(StudyProgram, TheCommandOfARowGivesItsBits) {
  const auto results = run(small_study({{"changes", {{"set", {{"resolution", 16}, {"denoise_*.kernel", "isotropic"}}}}},
                                        {"variants",
                                         {{{"name", "some"},
                                           {"variants", {"no_temporal"}},
                                           {"disable", {"denoise_box_*"}},
                                           {"set", {{"trace.ward", "bounded"}}}}}},
                                        {"sweep", {{"paths", {2}}, {"general", {true}}}},
                                        {"seeds", {9}},
                                        {"frames", {{"count", 2}, {"first", 3}, {"per_second", 12.5}}}}));
  ASSERT_EQ(results.rows.size(), 1U);
  std::vector<std::string> words = results.rows[0].command;
  ASSERT_EQ(words.front(), "lightloom");
  words.erase(words.begin());
  words.insert(words.end(), {"--out", (folder_ / "again").string()});
  ASSERT_EQ(run_program(words), 0) << log();
  fs::path kept;
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "out/cells"))
    if (entry.path().filename() == "radiance.0004.exr") kept = entry.path();
  ASSERT_FALSE(kept.empty());
  const image::ExrImage cell = image::read_exr(kept);
  const image::ExrImage again = image::read_exr(folder_ / "again/radiance.0004.exr");
  EXPECT_EQ(cell.channels, again.channels);
  EXPECT_TRUE(cell.samples == again.samples);
}

TEST_F(StudyProgram, AnAblationNeedsNoFile) {
  const std::vector<std::string> words = {"study",
                                          "--graph",
                                          (source_dir() / "graphs/paper.json").string(),
                                          "--scene",
                                          (source_dir() / "samples/scenes/atrium.scene.json").string(),
                                          "--ablate",
                                          "denoise_box_*",
                                          "--factorial",
                                          "--size",
                                          "32x24",
                                          "--trace-size",
                                          "32x24",
                                          "--set",
                                          "resolution=16",
                                          "--frames",
                                          "2",
                                          "--reference-set",
                                          "paths=2",
                                          "-o",
                                          (folder_ / "out").string()};
  std::vector<std::string> dry = words;
  dry.emplace_back("--dry-run");
  ASSERT_EQ(run_program(dry), 0) << log();
  EXPECT_THAT(log(), ::testing::HasSubstr("4 cells of 2 frames, 4 to do, and 1 references"));
  ASSERT_EQ(run_program(words), 0) << log();
  EXPECT_THAT(log(), ::testing::HasSubstr("without denoise_box_x and denoise_box_y"));
  ASSERT_EQ(run_program(dry), 0) << log();
  EXPECT_THAT(log(), ::testing::HasSubstr("4 cells of 2 frames, 0 to do"));
  for (const char* file : {"results.csv", "cells.csv", "results.json", "report.html"})
    EXPECT_TRUE(fs::exists(folder_ / "out" / file)) << file;
}

TEST_F(StudyProgram, TheStudiesThatComeWithItCanBeRun) {
  size_t studies = 0;
  for (const auto& entry : fs::directory_iterator(source_dir() / "samples/studies")) {
    ++studies;
    EXPECT_EQ(run_program({"study", entry.path().string(), "--dry-run", "-o", (folder_ / "out").string()}), 0) << log();
    EXPECT_THAT(log(), ::testing::HasSubstr("cells of")) << entry.path();
    EXPECT_THAT(log(), ::testing::Not(::testing::HasSubstr("cannot be run"))) << entry.path();
  }
  EXPECT_EQ(studies, 8U);
}

TEST_F(StudyProgram, WrongUsageIsTold) {
  const std::string graph = (source_dir() / "graphs/paper.json").string();
  const std::string scene = (source_dir() / "samples/scenes/atrium.scene.json").string();
  const auto expect = [&](int status, const std::vector<std::string>& words, const std::string& says) {
    std::vector<std::string> all = {"study", "-o", (folder_ / "out").string()};
    all.insert(all.end(), words.begin(), words.end());
    EXPECT_EQ(run_program(all), status) << log();
    EXPECT_THAT(log(), ::testing::HasSubstr(says));
  };
  expect(2, {}, "--graph");
  expect(2, {"--graph", graph, "--scene", scene, "--factorial"}, "--ablate");
  expect(2, {"--graph", graph, "--scene", scene, "--ablate", "denoice"}, "matches no pass that runs");
  expect(2, {"--graph", graph, "--scene", scene, "--sweep", "pats=1,2"}, "did you mean 'paths'?");
  expect(2, {"--graph", graph, "--scene", scene, "--metrics", "flop"}, "did you mean 'flip'?");
  expect(3, {"--graph", graph, "--scene", scene, "--camera", "nowhere"}, "nowhere");
  expect(3, {(folder_ / "missing.json").string()}, "cannot read");
  EXPECT_FALSE(fs::exists(folder_ / "out/results.csv"));
}

}  // namespace
}  // namespace lightloom::test
