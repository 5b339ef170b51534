// The program, killed at moments that nobody chose, goes on from its checkpoint.
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/run_files.hpp"
#include "tests/support/source_dir.hpp"

extern char** environ;

namespace lightloom::cli {
namespace {

namespace fs = std::filesystem;

pid_t start(std::vector<std::string> arguments) {
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", 0x1 /* O_WRONLY */, 0);
  pid_t child = 0;
  EXPECT_EQ(posix_spawn(&child, LIGHTLOOM_PROGRAM, &actions, nullptr, pointers.data(), environ), 0);
  posix_spawn_file_actions_destroy(&actions);
  return child;
}

/// Its exit status; -1 if it was killed, which happens after `limit`.
int wait_or_kill(pid_t child, std::chrono::milliseconds limit) {
  const auto end = std::chrono::steady_clock::now() + limit;
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > end) {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      return -1;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Kill, AKilledRenderResumesFromItsLastCheckpoint) {
  const fs::path folder = fs::temp_directory_path() / ("lightloom-kill-" + std::to_string(getpid()));
  fs::create_directories(folder);
  const auto command = [&](const char* out) {
    return std::vector<std::string>{"lightloom",
                                    "render",
                                    (source_dir() / "graphs/paper.json").string(),
                                    "--scene",
                                    (source_dir() / "samples/scenes/atrium.scene.json").string(),
                                    "--size",
                                    "40x30",
                                    "--trace-size",
                                    "20x15",
                                    "--set",
                                    "resolution=24",
                                    "--frames",
                                    "0..11",
                                    "--out",
                                    (folder / out).string()};
  };
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(wait_or_kill(start(command("whole")), std::chrono::minutes(3)), 0);
  const auto whole = std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - begin);

  std::vector<std::string> resumable = command("parts");
  resumable.insert(resumable.end(), {"--checkpoint", "1", "--resume"});
  std::mt19937 random(std::random_device{}());
  std::uniform_int_distribution<int64_t> moment(whole.count() / 3, whole.count());
  int kills = 0;
  int status = -1;
  for (int attempt = 0; attempt < 5 && status != 0; ++attempt) {
    status = wait_or_kill(start(resumable), std::chrono::milliseconds(moment(random)));
    ASSERT_LE(status, 0) << "it ended by itself with an error";
    kills += status == -1 ? 1 : 0;
    if (status == -1) {
      EXPECT_FALSE(fs::exists(folder / "parts/run.json")) << "a run that is not finished must not look so";
    }
  }
  if (status != 0) status = wait_or_kill(start(resumable), std::chrono::minutes(3));
  EXPECT_EQ(status, 0);
  EXPECT_EQ(test::first_difference(folder / "whole", folder / "parts"), "") << "after " << kills << " kills";
  fs::remove_all(folder);
}

}  // namespace
}  // namespace lightloom::cli
