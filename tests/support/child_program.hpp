#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <vector>

extern char** environ;

namespace lightloom::test {

/// A program that runs beside the test; killed at the end of the object if it still does.
class ChildProgram {
 public:
  /// `arguments` without the program's own name; its messages go to the file `errors`, its output nowhere.
  ChildProgram(const std::string& program, std::vector<std::string> arguments,
               const std::filesystem::path& errors = "/dev/null") {
    arguments.insert(arguments.begin(), "lightloom");
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    EXPECT_EQ(posix_spawn(&process_, program.c_str(), &actions, nullptr, pointers.data(), environ), 0);
    posix_spawn_file_actions_destroy(&actions);
  }
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;
  ~ChildProgram() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }

  void send(int signal) const { ::kill(process_, signal); }
  [[nodiscard]] pid_t process() const { return process_; }

  [[nodiscard]] bool running() {
    if (process_ <= 0) return false;
    int status = 0;
    if (::waitpid(process_, &status, WNOHANG) == 0) return true;
    take(status);
    return false;
  }

  /// Waits until `ready` or the end of the program; false where neither comes within `limit`.
  bool wait_for(const std::function<bool()>& ready, std::chrono::milliseconds limit = std::chrono::minutes(2)) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!ready()) {
      if (!running() || std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return true;
  }

  /// Its exit status, or 1000 + the signal that killed it. It is killed after `limit`: 1000 + SIGKILL.
  int wait(std::chrono::milliseconds limit = std::chrono::minutes(3)) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (running()) {
      if (std::chrono::steady_clock::now() > end) send(SIGKILL);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return status_;
  }

 private:
  void take(int status) {
    status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
    process_ = 0;
  }

  pid_t process_ = 0;
  int status_ = 0;
};

}  // namespace lightloom::test
