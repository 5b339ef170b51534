// `lightloom new pass`: what it writes works as it comes out. tests/plugin builds and runs the plug-in.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "framework/base/file.hpp"
#include "tests/cli/program_fixture.hpp"

namespace lightloom::cli {
namespace {

using ::testing::HasSubstr;

class NewPass : public ProgramTest {
 protected:
  NewPass() : ProgramTest({}) {}
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
};

TEST_F(NewPass, WritesAComputePassThatCompiles) {
  ASSERT_EQ(run({"new", "pass", "glow", "--compute", "--out", path("glow")}), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("glow/glow.comp\n"));
  EXPECT_THAT(out_, HasSubstr("lightloom render " + path("glow") + "/glow.json --scene SCENE"));
  EXPECT_EQ(run({"check", path("glow/glow.json")}), 0) << out_;
  EXPECT_EQ(run({"plan", path("glow/glow.json"), "--set", "glow_pass.strength=2"}), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("glow_pass (compute) strength=2"));
  EXPECT_EQ(run({"plan", path("glow/glow.json"), "--disable", "glow_pass"}), 0) << err_;
}

TEST_F(NewPass, WritesAPlugIn) {
  ASSERT_EQ(run({"new", "pass", "glow", "--out", path("made/glow") + "/"}), 0) << err_;
  for (const std::string file : {"CMakeLists.txt", "glow.cpp", "shaders/glow.comp", "glow.json", "README.md"}) {
    EXPECT_THAT(out_, HasSubstr("made/glow/" + file + "\n"));
    const std::string text = read_text_file(folder_ / "made/glow" / file);
    EXPECT_EQ(text.find('@'), std::string::npos) << text;
  }
  EXPECT_THAT(out_, HasSubstr("cmake --build"));
  EXPECT_EQ(run({"check", path("made/glow/glow.json")}), 3) << "the type is the plug-in's";
}

TEST_F(NewPass, OverwritesNothing) {
  std::filesystem::create_directories(folder_ / "glow");
  ASSERT_EQ(run({"new", "pass", "glow", "--compute", "--out", path("glow")}), 0)
      << "an empty folder is as good as none";
  std::ofstream(folder_ / "glow/glow.comp") << "mine";
  EXPECT_EQ(run({"new", "pass", "glow", "--out", path("glow")}), 3);
  EXPECT_THAT(err_, HasSubstr("is there already"));
  EXPECT_EQ(read_text_file(folder_ / "glow/glow.comp"), "mine");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "glow/CMakeLists.txt"));
  std::ofstream(folder_ / "file") << "mine";
  EXPECT_EQ(run({"new", "pass", "glow", "--out", path("file")}), 3);
  EXPECT_EQ(run({"new", "pass", "glow", "--out", path("file/below")}), 1) << "no folder can be made in a file";
}

TEST_F(NewPass, NamesAreChecked) {
  for (const std::string name : {"Glow", "2glow", "../glow", "glow-er", "", "gather", "compute"}) {
    EXPECT_EQ(run({"new", "pass", name, "--out", path("glow")}), 2) << name;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "glow")) << name;
  }
  EXPECT_EQ(run({"new"}), 2);
  EXPECT_EQ(run({"new", "graph"}), 2);
}

}  // namespace
}  // namespace lightloom::cli
