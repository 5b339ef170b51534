#include "framework/run/run_progress.hpp"

#include <gtest/gtest.h>

namespace lightloom::run {
namespace {

RunProgress progress_after(uint32_t frames) {
  RunProgress progress;
  for (uint32_t frame = 0; frame < frames; ++frame) progress.add(frame, {{"a", frame * 2.0}, {"b", 1}});
  return progress;
}

TEST(RunProgress, KeepsEveryFrameOfShortRuns) {
  const RunProgress progress = progress_after(1024);
  EXPECT_EQ(progress.frames(), 1024U);
  EXPECT_EQ(progress.timed_every, 1U);
  ASSERT_EQ(progress.wall_milliseconds.size(), 1024U);
  EXPECT_EQ(progress.wall_milliseconds[1023], 1023);
}

TEST(RunProgress, KeepsEvenlySpacedFramesOfLongOnes) {
  for (const uint32_t frames : {1025U, 2048U, 2049U, 100'000U}) {
    const RunProgress progress = progress_after(frames);
    EXPECT_EQ(progress.frames(), frames);
    EXPECT_LE(progress.wall_milliseconds.size(), RunProgress::kMostTimed);
    EXPECT_GT(progress.wall_milliseconds.size(), RunProgress::kMostTimed / 2 - 1);
    ASSERT_EQ(progress.pass_times.size(), progress.wall_milliseconds.size());
    for (size_t i = 0; i < progress.wall_milliseconds.size(); ++i) {
      EXPECT_EQ(progress.wall_milliseconds[i], static_cast<double>(i) * progress.timed_every) << frames;
      EXPECT_EQ(progress.pass_times[i].at(0).milliseconds, static_cast<double>(i) * progress.timed_every * 2);
    }
  }
}

TEST(RunProgress, GoesThroughAFileAndOn) {
  RunProgress whole = progress_after(5000);
  RunProgress resumed = progress_from_json(to_json(progress_after(3001)));
  for (uint32_t frame = 3001; frame < 5000; ++frame) resumed.add(frame, {{"a", frame * 2.0}, {"b", 1}});
  EXPECT_EQ(to_json(resumed), to_json(whole));
}

TEST(RunProgress, TakesNoMoreRoomInACheckpointTheLongerItRuns) {
  const size_t full = to_json(progress_after(1024)).dump().size();
  EXPECT_LT(to_json(progress_after(1'000'000)).dump().size(), full * 2);
}

}  // namespace
}  // namespace lightloom::run
