// Devices that are lost, hang, or have too little memory: what is said, what is kept, and that a run can go on.
#include <chrono>

#include "tests/faults/fault_fixture.hpp"
#include "tests/support/child_program.hpp"
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

  /// As `render`, in a process of its own, which ends with what a device that hangs leaves behind.
  int render_apart(const std::string& faults, const std::vector<std::string>& words) {
    setenv("LIGHTLOOM_FAULTS", faults.c_str(), 1);
    test::ChildProgram child(LIGHTLOOM_PROGRAM, words, folder_ / "messages");
    const int status = child.wait();
    err_ = read_text_file(folder_ / "messages");
    return status;
  }

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
  EXPECT_THAT(err_, HasSubstr("error: frame 3, in or after its last pass: waiting for"));
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
  const std::string faults = "type=discrete;fail=vkWaitForFences:9:VK_TIMEOUT";
  const int code = render_apart(faults, arguments("hung", kFrames));
  unsetenv("LIGHTLOOM_DEVICE_TIMEOUT");
  EXPECT_EQ(code, 1);
  EXPECT_THAT(err_, AllOf(HasSubstr("did not finish its work within 7 s"), HasSubstr("LIGHTLOOM_DEVICE_TIMEOUT")));
  EXPECT_EQ(render_apart(faults, arguments("hung", kFrames)), 1);
  EXPECT_THAT(err_, HasSubstr("within 120 s"));
  setenv("LIGHTLOOM_DEVICE_TIMEOUT", "soon", 1);
  EXPECT_EQ(render("", "never"), 2);
  unsetenv("LIGHTLOOM_DEVICE_TIMEOUT");
  EXPECT_THAT(err_, HasSubstr("LIGHTLOOM_DEVICE_TIMEOUT is 'soon'"));
}

// Half a minute of work for eight cores at the least, and drivers without a guard never end it.
TEST_F(LostDevice, OneThatReallyHangsIsLeftToTheEndOfTheProcess) {
  std::ofstream(folder_ / "spin.comp") << R"(#version 460
layout(local_size_x = 8, local_size_y = 8) in;
uniform writeonly image2D out_radiance;
layout(push_constant) uniform Params { int limit; };
void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  uint number = uint(pixel.x);
  for (int a = 0; a != limit; --a)
    for (int b = 0; b != limit; --b) number = number * 1664525u ^ uint(a + b);
  imageStore(out_radiance, pixel, vec4(float(number)));
})";
  std::ofstream(folder_ / "spin.json") << R"({"lightloom": 1, "name": "spin", "view": {"width": 4096, "height": 4096},
    "passes": {"spin": {"type": "compute", "shader": "spin.comp", "out": {"radiance": {"format": "rgba16_sfloat"}},
                        "params": {"limit": 3}}},
    "outputs": {"radiance": "spin.radiance"}})";
  unsetenv("VK_INSTANCE_LAYERS");
  setenv("LIGHTLOOM_DEVICE_TIMEOUT", "2", 1);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(render_apart("", {"render", (folder_ / "spin.json").string(), "--scene",
                              (source_dir() / "samples/scenes/atrium.scene.json").string(), "--out",
                              (folder_ / "spin").string()}),
            1);
  unsetenv("LIGHTLOOM_DEVICE_TIMEOUT");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
  EXPECT_THAT(err_, AllOf(HasSubstr("error: frame 0, "), HasSubstr("did not finish its work within 2 s")));
  EXPECT_TRUE(names_in("spin").empty());
}

// Its first error is what is said first, where the frame before cannot be written either.
TEST_F(LostDevice, OnAFullDiskBothAreSaid) {
  ASSERT_EQ(render("", "count", 2), 0) << err_;
  const std::string last = std::to_string(calls_["vkWaitForFences"]);
  // The plan, and the two pictures of the first frame: the last of these cannot get its name. It is tried when the
  // device is lost already, else the run would end for the disk alone.
  const std::string mark = (folder_ / "device_is_lost").string();
  const std::map<std::string, std::string> files{{"LD_PRELOAD", LIGHTLOOM_FILE_FAULTS},
                                                 {"LIGHTLOOM_FILE_PREFIX", (folder_ / "lost").string()},
                                                 {"LIGHTLOOM_FILE_CALL", "rename"},
                                                 {"LIGHTLOOM_FILE_NTH", "3"},
                                                 {"LIGHTLOOM_FILE_ERRNO", std::to_string(ENOSPC)},
                                                 {"LIGHTLOOM_FILE_HOLD", mark},
                                                 {"LIGHTLOOM_FILE_STAYS", "1"}};
  for (const auto& [name, value] : files) setenv(name.c_str(), value.c_str(), 1);
  const int status =
      render_apart("mark=" + mark + ";fail=vkWaitForFences:" + last + ":VK_ERROR_DEVICE_LOST", arguments("lost", 2));
  for (const auto& [name, value] : files) unsetenv(name.c_str());
  EXPECT_EQ(status, 1);
  EXPECT_THAT(err_, AllOf(HasSubstr("VK_ERROR_DEVICE_LOST; the frames before are not all written either: "),
                          HasSubstr("No space left on device")));
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
