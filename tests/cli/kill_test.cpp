// The program, killed at moments that nobody chose, goes on from its checkpoint.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <random>
#include <string>
#include <vector>

#include "tests/support/child_program.hpp"
#include "tests/support/run_files.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kKilled = 1000 + SIGKILL;  ///< ChildProgram::wait

TEST(Kill, AKilledRenderResumesFromItsLastCheckpoint) {
  const fs::path folder = fs::temp_directory_path() / ("lightloom-kill-" + std::to_string(getpid()));
  fs::create_directories(folder);
  const auto command = [&](const char* out) {
    return std::vector<std::string>{"render",       (source_dir() / "graphs/paper.json").string(),
                                    "--scene",      (source_dir() / "samples/scenes/atrium.scene.json").string(),
                                    "--size",       "40x30",
                                    "--trace-size", "20x15",
                                    "--set",        "resolution=24",
                                    "--frames",     "0..11",
                                    "--out",        (folder / out).string()};
  };
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(test::ChildProgram(LIGHTLOOM_PROGRAM, command("whole")).wait(), 0);
  const auto whole = std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - begin);

  std::vector<std::string> resumable = command("parts");
  resumable.insert(resumable.end(), {"--checkpoint", "1", "--resume"});
  std::mt19937 random(std::random_device{}());
  std::uniform_int_distribution<int64_t> moment(whole.count() / 3, whole.count());
  int kills = 0;
  int status = kKilled;
  for (int attempt = 0; attempt < 5 && status != 0; ++attempt) {
    status = test::ChildProgram(LIGHTLOOM_PROGRAM, resumable).wait(std::chrono::milliseconds(moment(random)));
    ASSERT_TRUE(status == 0 || status == kKilled) << "it ended by itself with an error";
    kills += status == kKilled ? 1 : 0;
    if (status == kKilled) {
      EXPECT_FALSE(fs::exists(folder / "parts/run.json")) << "a run that is not finished must not look so";
    }
  }
  if (status != 0) status = test::ChildProgram(LIGHTLOOM_PROGRAM, resumable).wait();
  EXPECT_EQ(status, 0);
  EXPECT_EQ(test::first_difference(folder / "whole", folder / "parts"), "") << "after " << kills << " kills";
  fs::remove_all(folder);
}

}  // namespace
}  // namespace lightloom::cli
