// The program, asked to stop by signals: what was finished stays, and the run can go on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "framework/base/file.hpp"
#include "framework/image/read_image.hpp"
#include "tests/support/child_program.hpp"
#include "tests/support/run_files.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::cli {
namespace {

namespace fs = std::filesystem;
using test::ChildProgram;
using ::testing::HasSubstr;
using Words = std::vector<std::string>;

constexpr int kKilled = 1000;  ///< ChildProgram::wait of a killed program

class Interruption : public ::testing::Test {
 protected:
  Interruption() { fs::create_directories(folder_); }
  ~Interruption() override { fs::remove_all(folder_); }

  [[nodiscard]] Words render(const std::string& out, const std::string& frames, const Words& more = {}) const {
    Words words = {"render",       (source_dir() / "graphs/paper.json").string(),
                   "--scene",      (source_dir() / "samples/scenes/atrium.scene.json").string(),
                   "--size",       "24x18",
                   "--trace-size", "12x9",
                   "--set",        "resolution=16",
                   "--frames",     frames,
                   "--out",        (folder_ / out).string()};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  [[nodiscard]] std::string messages() const { return read_text_file(folder_ / "log"); }
  [[nodiscard]] nlohmann::json record(const std::string& out) const {
    return nlohmann::json::parse(read_text_file(folder_ / out / "run.json"));
  }

  /// Every file that run.json lists is there and whole, and there is no other.
  void expect_whole(const std::string& out) const {
    std::set<std::string> listed = {"run.json"};
    const nlohmann::json whole = record(out);
    for (const nlohmann::json& file : whole["files"]) listed.insert(file.get<std::string>());
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_ / out)) {
      if (!entry.is_regular_file()) continue;
      EXPECT_EQ(listed.erase(fs::relative(entry.path(), folder_ / out).generic_string()), 1u) << entry.path();
      const std::string kind = entry.path().extension().string();
      if (kind != ".exr" && kind != ".png") continue;
      EXPECT_NO_THROW(static_cast<void>(image::read_image(entry.path()))) << entry.path();
    }
    EXPECT_TRUE(listed.empty()) << *listed.begin();
  }

  const fs::path folder_ = fs::temp_directory_path() / ("lightloom-interrupt-" + std::to_string(getpid()));
};

TEST_F(Interruption, ARenderEndsAfterItsFrameAndGoesOnLater) {
  ChildProgram child(LIGHTLOOM_PROGRAM, render("parts", "0..99999", {"--checkpoint", "1000"}), folder_ / "log");
  ASSERT_TRUE(child.wait_for([&] { return fs::exists(folder_ / "parts/image.0002.png"); })) << messages();
  child.send(SIGINT);
  EXPECT_EQ(child.wait(), 130);
  const nlohmann::json interrupted = record("parts");
  EXPECT_EQ(interrupted["interrupted"]["by"], "SIGINT");
  const uint32_t last = interrupted["frames"]["last"];
  EXPECT_GE(last, 2u);
  EXPECT_THAT(messages(), HasSubstr("interrupted by SIGINT after " + std::to_string(last + 1) +
                                    " of 100000 frames, which are whole\n  hint: the same command with --resume"));
  expect_whole("parts");
  const std::string frames = "0.." + std::to_string(last + 2);
  ASSERT_EQ(ChildProgram(LIGHTLOOM_PROGRAM, render("parts", frames, {"--checkpoint", "1000", "--resume"})).wait(), 0);
  ASSERT_EQ(ChildProgram(LIGHTLOOM_PROGRAM, render("whole", frames, {"--checkpoint", "1000"})).wait(), 0);
  EXPECT_EQ(test::first_difference(folder_ / "whole", folder_ / "parts"), "");
  EXPECT_EQ(record("parts")["resumed_at"], nlohmann::json::array({last + 1}));
  EXPECT_FALSE(record("parts").contains("interrupted"));
}

TEST_F(Interruption, AtAnyMomentNothingHalfDoneStays) {
  ASSERT_EQ(ChildProgram(LIGHTLOOM_PROGRAM, render("warm", "0")).wait(), 0) << "caches are filled";
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(ChildProgram(LIGHTLOOM_PROGRAM, render("timed", "0..5")).wait(), 0);
  const auto whole =
      std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - begin).count();
  std::mt19937 random(std::random_device{}());
  int stopped = 0;
  for (int attempt = 0; attempt < 12; ++attempt) {
    const int signal = attempt % 3 == 0 ? SIGTERM : attempt % 3 == 1 ? SIGINT : SIGHUP;
    const std::string out = "out" + std::to_string(attempt);
    ChildProgram child(LIGHTLOOM_PROGRAM, render(out, "0..5", {"--dump", "trace.radiance"}), folder_ / "log");
    std::this_thread::sleep_for(std::chrono::milliseconds(attempt * whole / 11));
    child.send(signal);
    const int status = child.wait();
    // Before the program listens it ends as any other would.
    ASSERT_TRUE(status == 128 + signal || status == kKilled + signal || status == 0) << status << messages();
    stopped += status == 128 + signal ? 1 : 0;
    if (fs::exists(folder_ / out)) expect_whole(out);
  }
  EXPECT_GT(stopped, 2) << "hardly anything was interrupted: the test shows nothing";
}

TEST_F(Interruption, AFrameOfTheHostIsLeftAtOnce) {
  Words words = render("host", "0");
  words[1] = (source_dir() / "graphs/reference.json").string();
  words.insert(words.end(), {"--set", "paths=16384"});
  words.erase(std::find(words.begin(), words.end(), "--trace-size"), std::find(words.begin(), words.end(), "--set"));
  words.erase(std::find(words.begin(), words.end(), "resolution=16") - 1,
              std::find(words.begin(), words.end(), "--frames"));
  ChildProgram child(LIGHTLOOM_PROGRAM, words, folder_ / "log");
  std::this_thread::sleep_for(std::chrono::seconds(2));
  ASSERT_TRUE(child.running()) << messages();
  child.send(SIGTERM);
  EXPECT_EQ(child.wait(std::chrono::seconds(10)), 143) << messages();
  EXPECT_THAT(messages(), HasSubstr("interrupted by SIGTERM"));
  EXPECT_FALSE(fs::exists(folder_ / "host")) << "no frame was done";
}

TEST_F(Interruption, TwoRendersIntoOneFolderAreRefused) {
  ChildProgram first(LIGHTLOOM_PROGRAM, render("shared", "0..99999"), folder_ / "log");
  ASSERT_TRUE(first.wait_for([&] { return fs::exists(folder_ / "shared/image.0000.png"); })) << messages();
  EXPECT_EQ(ChildProgram(LIGHTLOOM_PROGRAM, render("shared", "0"), folder_ / "second").wait(), 1);
  EXPECT_THAT(read_text_file(folder_ / "second"),
              HasSubstr("another render is running in '" + (folder_ / "shared").string() + "' (process " +
                        std::to_string(first.process())));
  const std::string picture = (folder_ / "shared/radiance.0000.exr").string();
  EXPECT_EQ(ChildProgram(LIGHTLOOM_PROGRAM, {"compare", picture, picture}).wait(), 0) << "reading is free";
  first.send(SIGINT);
  EXPECT_EQ(first.wait(), 130);
  EXPECT_EQ(ChildProgram(LIGHTLOOM_PROGRAM, render("shared", "0")).wait(), 0) << "free again";
  expect_whole("shared");
}

}  // namespace
}  // namespace lightloom::cli
