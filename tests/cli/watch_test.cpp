// The program under --watch: what it shows after an edit is what a fresh run shows; what is broken is said, and changes
// no file.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "framework/base/atomic_file.hpp"
#include "framework/base/file.hpp"
#include "tests/support/run_files.hpp"
#include "tests/support/source_dir.hpp"

extern char** environ;

namespace lightloom::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

class WatchTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("lightloom-watch-" + std::to_string(getpid()));
    fs::create_directories(folder_ / "shaders");
    fs::copy(source_dir() / "samples/scenes", folder_ / "scenes", fs::copy_options::recursive);
    graph_ = ordered_json::parse(read_text_file(source_dir() / "graphs/paper.json"));
    graph_["view"] = graph_["trace"] = {{"width", 32}, {"height", 24}};
    graph_["params"]["resolution"] = 16;
    write_graph();
  }
  void TearDown() override {
    if (watching_ > 0) {
      kill(watching_, SIGKILL);
      waitpid(watching_, nullptr, 0);
    }
    fs::remove_all(folder_);
  }

  void write_graph() const { std::ofstream(folder_ / "graph.json") << graph_.dump(1); }

  [[nodiscard]] pid_t start(const std::string& out, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"lightloom",
                                       "render",
                                       (folder_ / "graph.json").string(),
                                       "--scene",
                                       (folder_ / "scenes/atrium.scene.json").string(),
                                       "--frames",
                                       "0..1",
                                       "--shaders",
                                       (folder_ / "shaders").string(),
                                       "--out",
                                       (folder_ / out).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, (folder_ / (out + ".log")).c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    pid_t child = 0;
    EXPECT_EQ(posix_spawn(&child, LIGHTLOOM_PROGRAM, &actions, nullptr, pointers.data(), environ), 0);
    posix_spawn_file_actions_destroy(&actions);
    return child;
  }

  /// Waits for the next time that the watch waits, and returns what it said since the last time.
  std::string next_messages() {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    while (std::chrono::steady_clock::now() < end) {
      const std::string log = read_text_file(folder_ / "watched.log");
      const size_t waits = log.find("files for changes, until Ctrl-C\n", heard_);
      if (waits != std::string::npos) {
        const std::string messages = log.substr(heard_, waits - heard_);
        heard_ = log.find('\n', waits) + 1;
        return messages;
      }
      EXPECT_EQ(waitpid(watching_, nullptr, WNOHANG), 0) << "the watch ended: " << log;
      if (HasFailure()) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ADD_FAILURE() << "the watch says nothing";
    return {};
  }

  /// Where the watched pictures differ from those of a run that starts now.
  [[nodiscard]] std::string difference_from_fresh() const {
    int status = 0;
    waitpid(start("fresh", {}), &status, 0);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return read_text_file(folder_ / "fresh.log");
    return test::first_difference(folder_ / "fresh", folder_ / "watched");
  }

  /// After an edit: the pictures are new, and those of a fresh run.
  void expect_new_pictures(const std::string& changed) {
    const auto before = test::run_files(folder_ / "watched");
    const std::string messages = next_messages();
    EXPECT_NE(messages.find(changed + " changed: first frame after "), std::string::npos) << messages;
    EXPECT_NE(test::run_files(folder_ / "watched"), before) << changed;
    EXPECT_EQ(difference_from_fresh(), "") << changed;
    EXPECT_TRUE(fs::exists(folder_ / "watched/run.json"));
  }

  /// After an edit that breaks something: every file, run.json too, is as it was.
  void expect_old_pictures(const std::vector<std::string>& said) {
    const auto before = test::run_files(folder_ / "watched");
    const std::string record = read_text_file(folder_ / "watched/run.json");
    const std::string messages = next_messages();
    for (const std::string& part : said) EXPECT_NE(messages.find(part), std::string::npos) << messages;
    EXPECT_NE(messages.find("the pictures stay as they were; watching "), std::string::npos) << messages;
    EXPECT_EQ(test::run_files(folder_ / "watched"), before);
    EXPECT_EQ(read_text_file(folder_ / "watched/run.json"), record);
  }

  fs::path folder_;
  ordered_json graph_;
  pid_t watching_ = 0;
  size_t heard_ = 0;
};

TEST_F(WatchTest, EditsShowAndMistakesAreSaid) {
  watching_ = start("watched", {"--watch"});
  const std::string first = next_messages();
  EXPECT_TRUE(first.starts_with("watching ")) << "no problem: " << first;

  graph_["params"]["exposure"] = 1.5;
  write_graph();
  expect_new_pictures("graph.json");

  const std::string good = graph_.dump(1);
  std::ofstream(folder_ / "graph.json") << good.substr(0, good.size() / 2);
  expect_old_pictures({"graph.json:"});
  ordered_json misspelt = graph_;
  misspelt["passes"]["tonemap"]["type"] = "tonemapp";
  write_file_atomically(folder_ / "graph.json", misspelt.dump(1));
  expect_old_pictures({"graph.json:", "tonemap"});
  fs::remove(folder_ / "graph.json");
  expect_old_pictures({"cannot read", "graph.json"});
  graph_["params"]["exposure"] = -1;
  write_graph();
  expect_new_pictures("graph.json");

  // A shader of one's own takes the place of the program's, although it was not there when that was read.
  std::string shader = read_text_file(source_dir() / "shaders/tonemap.comp");
  const size_t body = shader.find("void main() {");
  ASSERT_NE(body, std::string::npos);
  std::string broken = shader;
  broken.insert(body, "this is no GLSL\n");
  std::ofstream(folder_ / "shaders/tonemap.comp") << broken;
  const auto line = 1 + std::count(shader.begin(), shader.begin() + static_cast<std::ptrdiff_t>(body), '\n');
  expect_old_pictures({"tonemap.comp:" + std::to_string(line)});
  const size_t store = shader.find("imageStore(");
  ASSERT_NE(store, std::string::npos);
  shader.insert(store, "color *= 0.5;\n  ");
  write_file_atomically(folder_ / "shaders/tonemap.comp", shader);
  expect_new_pictures("tonemap.comp");

  ordered_json scene = ordered_json::parse(read_text_file(folder_ / "scenes/atrium.scene.json"));
  scene["sun"]["angular_radius_degrees"] = 6;
  std::ofstream(folder_ / "scenes/atrium.scene.json") << scene.dump(1);
  expect_new_pictures("atrium.scene.json");

  EXPECT_EQ(kill(watching_, SIGINT), 0);
  int status = 0;
  waitpid(watching_, &status, 0);
  watching_ = 0;
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 130);
}

}  // namespace
}  // namespace lightloom::cli
