// The driver's pipelines on disk, as the whole program keeps them: what the driver is given, and --no-cache.
#include <optional>

#include "tests/faults/fault_fixture.hpp"
#include "tests/support/child_program.hpp"
#include "tests/support/run_files.hpp"

namespace lightloom::cli {
namespace {

namespace fs = std::filesystem;

class PipelinesOnDisk : public FaultTest {
 protected:
  PipelinesOnDisk() {
    if (const char* before = std::getenv("LIGHTLOOM_CACHE")) before_ = before;
    setenv("LIGHTLOOM_CACHE", cache().c_str(), 1);
  }
  ~PipelinesOnDisk() override {
    if (before_)
      setenv("LIGHTLOOM_CACHE", before_->c_str(), 1);
    else
      unsetenv("LIGHTLOOM_CACHE");
  }

  [[nodiscard]] fs::path cache() const { return folder_ / "cache"; }
  [[nodiscard]] std::vector<fs::path> kept(const std::string& extension) const {
    std::vector<fs::path> files;
    if (!fs::exists(cache())) return files;
    for (const auto& entry : fs::directory_iterator(cache()))
      if (entry.path().extension() == extension) files.push_back(entry.path());
    return files;
  }
  void expect_same(const std::string& out) {
    expect_clean();
    EXPECT_EQ(test::first_difference(folder_ / out, folder_ / "good"), "");
  }

  std::optional<std::string> before_;
};

TEST_F(PipelinesOnDisk, TheNextRunsDriverIsGivenThemAndThePicturesAreTheSame) {
  ASSERT_EQ(render("", "good"), 0) << err_;
  EXPECT_EQ(calls_["pipeline_cache_bytes"], 0u);
  ASSERT_EQ(kept(".pipelines").size(), 1u);
  ASSERT_EQ(render("", "again"), 0) << err_;
  EXPECT_EQ(calls_["pipeline_cache_bytes"], fs::file_size(kept(".pipelines")[0]) - 56);
  expect_same("again");
  ASSERT_EQ(render("", "without", 2, {"--no-cache"}), 0) << err_;
  EXPECT_EQ(calls_["vkCreatePipelineCache"], 0u);
  expect_same("without");
}

TEST_F(PipelinesOnDisk, ADriverThatRefusesThemOrHasNoCacheOnlyCostsTime) {
  ASSERT_EQ(render("", "good"), 0) << err_;
  ASSERT_EQ(render("fail=vkCreatePipelineCache:1:VK_ERROR_UNKNOWN", "refused"), 0) << err_;
  EXPECT_EQ(struck_, 1u);
  EXPECT_EQ(calls_["vkCreatePipelineCache"], 2u) << "it was not tried without the file";
  expect_same("refused");
  ASSERT_EQ(render("fail=vkCreatePipelineCache:1+:VK_ERROR_OUT_OF_HOST_MEMORY", "none"), 0) << err_;
  expect_same("none");
  EXPECT_EQ(calls_["vkGetPipelineCacheData"], 0u);
}

TEST_F(PipelinesOnDisk, ADriverThatDoesNotGiveThemLeavesNoFile) {
  for (const char* result : {"VK_ERROR_OUT_OF_HOST_MEMORY", "VK_INCOMPLETE"}) {
    ASSERT_EQ(render(std::string("fail=vkGetPipelineCacheData:2+:") + result, "good"), 0) << err_;
    EXPECT_EQ(struck_, 1u);
    expect_clean();
    EXPECT_TRUE(kept(".pipelines").empty()) << result;
  }
}

TEST_F(PipelinesOnDisk, ALostDeviceIsStillToldOf) {
  expect_clear_failure(render("fail=vkWaitForFences:9:VK_ERROR_DEVICE_LOST", "lost"), 1);
  EXPECT_THAT(err_, ::testing::HasSubstr("VK_ERROR_DEVICE_LOST"));
}

TEST_F(PipelinesOnDisk, TwoProcessesMayRenderAtOnce) {
  const auto command = [&](const char* out) {
    return std::vector<std::string>{"render",   (folder_ / "tiny.json").string(),
                                    "--scene",  (source_dir() / "samples/scenes/atrium.scene.json").string(),
                                    "--frames", "0..1",
                                    "--out",    (folder_ / out).string()};
  };
  unsetenv("VK_INSTANCE_LAYERS");
  {
    test::ChildProgram one(LIGHTLOOM_PROGRAM, command("one"));
    test::ChildProgram other(LIGHTLOOM_PROGRAM, command("other"));
    EXPECT_EQ(one.wait(), 0);
    EXPECT_EQ(other.wait(), 0);
  }
  EXPECT_EQ(test::first_difference(folder_ / "one", folder_ / "other"), "");
  EXPECT_EQ(kept(".pipelines").size(), 1u);
  for (const auto& entry : fs::directory_iterator(cache()))
    EXPECT_FALSE(entry.path().filename().string().starts_with(".")) << entry.path() << " was left behind";
}

class NoCache : public PipelinesOnDisk {
 protected:
  NoCache() { unsetenv("VK_INSTANCE_LAYERS"); }

  /// The option leaves no folder, and without it there is one.
  void expect_none_kept(const std::vector<std::string>& command) {
    SCOPED_TRACE(command[0]);
    std::vector<std::string> without = command;
    without.emplace_back("--no-cache");
    EXPECT_EQ(run(without), 0) << err_;
    EXPECT_FALSE(fs::exists(cache()));
    EXPECT_EQ(run(command), 0) << err_;
    EXPECT_TRUE(fs::exists(cache())) << "it keeps nothing, so that --no-cache has no effect";
    fs::remove_all(cache());
  }

  std::string scene_ = (source_dir() / "samples/scenes/atrium.scene.json").string();
  std::string tiny_ = (folder_ / "tiny.json").string();
};

TEST_F(NoCache, ReadsAndWritesNothingWithCommandsThatRenderAGraph) {
  const std::string run_folder = (folder_ / "dumped").string();
  expect_none_kept({"render", tiny_, "--scene", scene_, "--dump", "*", "--out", run_folder});
  expect_none_kept({"replay", run_folder, "tonemap"});
  expect_none_kept({"probe", tiny_, "3,3", "--scene", scene_});
  expect_none_kept({"bench", tiny_, "--scene", scene_, "--frames", "0..1", "--warm-up", "1"});
}

TEST_F(NoCache, ReadsAndWritesNothingWithTheOthers) {
  const std::string image = (folder_ / "good/radiance.0000.exr").string();
  ASSERT_EQ(render("", "good", 1, {"--no-cache"}), 0) << err_;
  expect_none_kept({"study", "--graph", tiny_, "--scene", scene_, "--ablate", "mean", "--frames", "1", "--warm-up", "0",
                    "--reference", image, "--no-times", "--fresh", "--out", (folder_ / "study").string()});
  expect_none_kept({"stability", "stored_directions"});
  expect_none_kept({"brdf", "--alpha", "0.2,0.2", "--wi", "30,0"});
  const std::string compute = (source_dir() / "samples/compute_pass/atrous.json").string();
  expect_none_kept({"plan", compute});
  expect_none_kept({"check", compute});
}

}  // namespace
}  // namespace lightloom::cli
