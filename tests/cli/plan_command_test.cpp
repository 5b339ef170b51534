#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "framework/base/file.hpp"
#include "tests/cli/program_fixture.hpp"
#include "tests/support/source_dir.hpp"

// The forms in which `lightloom plan` gives a plan; what they say is tested with the layer that makes them.
namespace lightloom::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kGraph = (source_dir() / "graphs/paper.json").string();
const std::string kScene = (source_dir() / "samples/scenes/atrium.scene.json").string();

class PlanCommand : public ProgramTest {
 protected:
  PlanCommand() : ProgramTest({"plan", kGraph, "--scene", kScene, "--size", "64x48", "--set", "resolution=16"}) {}

  /// A run whose passes all took a millisecond.
  std::string run_folder(const nlohmann::json& plan) {
    nlohmann::json passes = nlohmann::json::array();
    for (const auto& step : plan["steps"]) passes.push_back({{"pass", step["pass"]}, {"median_ms", 1.0}});
    std::ofstream(folder_ / "run.json") << nlohmann::json{{"graph", {{"plan_hash", plan["hash"]}}}, {"passes", passes}};
    return folder_.string();
  }
};

TEST_F(PlanCommand, gives_data) {
  ASSERT_EQ(run({"--format", "json"}), 0) << err_;
  const nlohmann::json bare = nlohmann::json::parse(out_);
  EXPECT_EQ(bare["graph"], "paper");
  EXPECT_TRUE(bare["memory"]["heaps"].is_null());
  EXPECT_TRUE(bare["times"].is_null());
  const std::string times = run_folder(bare);
  ASSERT_EQ(run({"--format", "json", "--memory", "--times", times}), 0) << err_;
  EXPECT_EQ(err_, "");
  const nlohmann::json full = nlohmann::json::parse(out_);
  EXPECT_EQ(full["hash"], bare["hash"]) << "sharing memory is the device's affair";
  EXPECT_GE(full["memory"]["heaps"].size(), 1U);
  EXPECT_EQ(full["times"]["sum_ms"], full["steps"].size());
  EXPECT_EQ(full["times"]["critical_path_ms"], full["times"]["critical_steps"].size());
}

TEST_F(PlanCommand, writes_a_file) {
  const std::filesystem::path file = folder_ / "plan.dot";
  EXPECT_EQ(run({"--format", "dot", "--out", file.string()}), 0) << err_;
  EXPECT_EQ(out_, "");
  EXPECT_THAT(read_text_file(file), AllOf(StartsWith("// dot"), HasSubstr("digraph \"paper\"")));
  EXPECT_EQ(run({"--format", "dot", "--out", (folder_ / "no/such/plan.dot").string()}), 1);
  EXPECT_EQ(run({"--format", "gif"}), 2);
}

TEST_F(PlanCommand, shows_what_overlapping_could_save) {
  ASSERT_EQ(run({"--format", "json"}), 0);
  const std::string times = run_folder(nlohmann::json::parse(out_));
  ASSERT_EQ(run({"--times", times}), 0);
  EXPECT_EQ(err_, "");
  EXPECT_THAT(out_, HasSubstr("overlapping passes can save at most"));
  ASSERT_EQ(run({"--times", times, "--disable", "denoise_*"}), 0);
  EXPECT_THAT(err_, HasSubstr("was of another plan"));
  EXPECT_EQ(run({"--times", (folder_ / "nowhere").string()}), 3);
  EXPECT_THAT(err_, HasSubstr("run.json"));
}

TEST_F(PlanCommand, verifies_in_any_form) {
  EXPECT_EQ(run({"--format", "json", "--verify"}), 0);
  EXPECT_TRUE(nlohmann::json::parse(out_).is_object());
  EXPECT_THAT(err_, HasSubstr("no violation"));
}

}  // namespace
}  // namespace lightloom::cli
