// Devices that are lost, hang, or have too little memory: what is said, what is kept, and that a run can go on.
#include "tests/faults/fault_fixture.hpp"
#include "tests/support/run_files.hpp"

namespace lightloom::cli {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr uint32_t kFrames = 4;

class LostDevice : public FaultTest {
 protected:
  void SetUp() override { ASSERT_EQ(render("", "good", kFrames, {"--checkpoint", "1"}), 0) << err_; }

  /// The frames that were finished are whole, and the run that goes on ends with the bits of one that never stopped.
  void expect_resumes(const std::string& out) {
    expect_nothing_half_written(out, "good");
    ASSERT_EQ(render("", out, kFrames, {"--checkpoint", "1", "--resume"}), 0) << err_;
    EXPECT_EQ(test::first_difference(folder_ / out, folder_ / "good"), "");
  }
};

TEST_F(LostDevice, InTheMiddleOfARunNamesTheFrameKeepsWhatWasFinishedAndResumesWithTheSameBits) {
  for (const char* function : {"vkQueueSubmit2", "vkWaitForFences"}) {
    const uint64_t calls = calls_.empty() ? 0 : calls_[function];
    if (calls == 0) {
      ASSERT_EQ(render("", "count", kFrames, {"--checkpoint", "1"}), 0) << err_;
    }
    // Two submissions for each value of a checkpoint and one for each frame: this is within the last frames.
    const std::string call = std::to_string(calls_[function] - 2);
    SCOPED_TRACE(std::string(function) + " " + call);
    const std::string out = std::string("lost_") + function;
    const int code = render("fail=" + std::string(function) + ":" + call + ":VK_ERROR_DEVICE_LOST", out, kFrames,
                            {"--checkpoint", "1"});
    expect_clear_failure(code, 1);
    EXPECT_THAT(err_, AllOf(HasSubstr("VK_ERROR_DEVICE_LOST"), HasSubstr("finished and kept in"),
                            HasSubstr("--resume to go on at frame")));
    expect_resumes(out);
    calls_.clear();
  }
}

TEST_F(LostDevice, TheFrameAndItsPassesAreNamed) {
  // Without checkpoints the last submission is that of the last frame.
  ASSERT_EQ(render("", "count", kFrames), 0) << err_;
  const std::string call = std::to_string(calls_["vkQueueSubmit2"]);
  expect_clear_failure(render("fail=vkQueueSubmit2:" + call + ":VK_ERROR_DEVICE_LOST", "lost", kFrames), 1);
  // It was lost before it took the commands, so no pass had begun.
  EXPECT_THAT(err_, ContainsRegex("error: frame 3, before the pass 'gather': vkQueueSubmit2 .*3 frames are finished"));
  // The layer lets the device end its work before it says that it is lost.
  expect_clear_failure(render("fail=vkWaitForFences:" + call + ":VK_ERROR_DEVICE_LOST", "waited", kFrames), 1);
  EXPECT_THAT(err_, HasSubstr("error: frame 3, after its last pass: waiting for"));
}

TEST_F(LostDevice, OneThatDoesNotTellItsTimesHasAllPassesNamed) {
  const uint64_t calls = calls_["vkGetQueryPoolResults"];
  const int code = render("fail=vkGetQueryPoolResults:" + std::to_string(calls) + "+:VK_ERROR_DEVICE_LOST", "lost",
                          kFrames, {"--checkpoint", "1"});
  expect_clear_failure(code, 1);
  EXPECT_THAT(err_, AllOf(HasSubstr("frame 3, in one of its passes gather, "), HasSubstr("3 frames are finished"),
                          HasSubstr("go on at frame 3")));
  expect_resumes("lost");
}

TEST_F(LostDevice, WithoutACheckpointItIsSaidHowToHaveOne) {
  const uint64_t calls = calls_["vkGetQueryPoolResults"];
  const int code =
      render("fail=vkGetQueryPoolResults:" + std::to_string(calls) + ":VK_ERROR_DEVICE_LOST", "lost", kFrames);
  expect_clear_failure(code, 1);
  EXPECT_THAT(err_, AllOf(HasSubstr("--checkpoint N"), Not(HasSubstr("go on at frame"))));
}

TEST_F(LostDevice, OneThatHangsIsGivenUpAfterItsTime) {
  setenv("LIGHTLOOM_DEVICE_TIMEOUT", "7", 1);
  const int code = render("type=discrete;fail=vkWaitForFences:9:VK_TIMEOUT", "hung", kFrames);
  unsetenv("LIGHTLOOM_DEVICE_TIMEOUT");
  EXPECT_EQ(code, 1);
  EXPECT_THAT(err_, AllOf(HasSubstr("did not finish its work within 7 s"), HasSubstr("LIGHTLOOM_DEVICE_TIMEOUT")));
  EXPECT_EQ(render("type=discrete;fail=vkWaitForFences:9:VK_TIMEOUT", "hung", kFrames), 1);
  EXPECT_THAT(err_, HasSubstr("within 120 s"));
  setenv("LIGHTLOOM_DEVICE_TIMEOUT", "soon", 1);
  EXPECT_EQ(render("", "never"), 2);
  unsetenv("LIGHTLOOM_DEVICE_TIMEOUT");
  EXPECT_THAT(err_, HasSubstr("LIGHTLOOM_DEVICE_TIMEOUT is 'soon'"));
}

TEST_F(LostDevice, SlownessIsNoFault) {
  EXPECT_EQ(render("delay=vkWaitForFences:3:300;delay=vkQueueSubmit2:5:300", "slow", kFrames), 0) << err_;
  EXPECT_EQ(struck_, 2u);
  expect_clean();
}

using ShortOfMemory = FaultTest;

TEST_F(ShortOfMemory, ItIsToldWhatIsNeededWhatThereIsAndWhatToLower) {
  // Cut off at eight megabytes, of which the scene takes a part: the grids of 96 voxels a side do not fit.
  const int code = render("heap=8000000;type=discrete", "short", 2, {"--set", "resolution=96"});
  expect_clear_failure(code, 1);
  EXPECT_THAT(err_,
              AllOf(HasSubstr("need"), HasSubstr("(8000000 bytes)"), HasSubstr("lower the param 'resolution' to")));
  EXPECT_TRUE(names_in("short").empty());
}

TEST_F(ShortOfMemory, AnAllocationThatFailsTellsTheWholeRunsNeed) {
  const int code = render("fail=vkAllocateMemory:30:VK_ERROR_OUT_OF_DEVICE_MEMORY", "short");
  expect_clear_failure(code, 1);
  EXPECT_THAT(err_, AllOf(HasSubstr("VK_ERROR_OUT_OF_DEVICE_MEMORY"), HasSubstr("the whole run needs"),
                          HasSubstr("voxel grids"), HasSubstr("textures"), HasSubstr("before it the device had")));
}

TEST_F(ShortOfMemory, TheHeapThatIsKeptToIsTheMostThatIsEverUsed) {
  int failed = 0;
  for (const char* heap : {"2000000", "4000000", "400000000"}) {
    const int code = render("heap=" + std::string(heap), std::string("heap") + heap);
    if (code == 0) continue;
    ++failed;
    expect_clear_failure(code, 1);
    EXPECT_THAT(err_, HasSubstr("the whole run needs"));
  }
  EXPECT_EQ(failed, 2);
}

}  // namespace
}  // namespace lightloom::cli
