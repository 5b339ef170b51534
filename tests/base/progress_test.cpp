#include "framework/base/progress.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace lightloom {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;
using ::testing::Not;

/// A clock that the test moves by hand.
struct HandClock {
  std::chrono::steady_clock::time_point now{};
  ProgressBar::Clock reading() {
    return [this] { return now; };
  }
};

TEST(ProgressBar, shows_task_count_share_and_time_left) {
  std::ostringstream stream;
  HandClock clock;
  ProgressBar bar(stream, true, "render", "frames", 16, clock.reading());
  clock.now += seconds(100);  // shaders are compiled
  bar.update(1);
  clock.now += seconds(33);
  stream.str("");
  bar.update(12);
  EXPECT_EQ(stream.str(), "\r\x1b[Krender  12/16 frames  ███████████████       75%  0:12 left");
}

TEST(ProgressBar, steps_that_were_there_already_say_nothing_of_the_time_left) {
  std::ostringstream stream;
  HandClock clock;
  ProgressBar bar(stream, true, "render", "frames", 1000, clock.reading());
  clock.now += seconds(10);
  bar.update(901);
  EXPECT_THAT(stream.str(), AllOf(HasSubstr("901/1000"), Not(HasSubstr("left"))));
  clock.now += seconds(10);
  bar.update(911);
  EXPECT_THAT(stream.str(), HasSubstr("911/1000 frames"));
  EXPECT_THAT(stream.str(), HasSubstr("1:29 left"));
}

TEST(ProgressBar, writes_nothing_where_there_is_no_terminal) {
  std::ostringstream stream;
  HandClock clock;
  {
    ProgressBar bar(stream, false, "render", "frames", 3, clock.reading());
    for (uint64_t i = 0; i <= 3; ++i) {
      clock.now += seconds(10);
      bar.update(i);
    }
  }
  EXPECT_EQ(stream.str(), "");
}

TEST(ProgressBar, wipes_its_line_at_the_end) {
  std::ostringstream stream;
  { const ProgressBar bar(stream, true, "render", "frames", 3); }
  EXPECT_TRUE(stream.str().ends_with("\r\x1b[K"));
  EXPECT_THAT(stream.str(), Not(HasSubstr("\n")));
}

TEST(ProgressBar, redraws_at_most_ten_times_a_second_but_always_the_last_step) {
  std::ostringstream stream;
  HandClock clock;
  ProgressBar bar(stream, true, "render", "frames", 1000, clock.reading());
  stream.str("");
  bar.update(1);
  clock.now += milliseconds(99);
  bar.update(2);
  EXPECT_EQ(stream.str(), "");
  clock.now += milliseconds(1);
  bar.update(3);
  EXPECT_THAT(stream.str(), HasSubstr("3/1000"));
  bar.update(1000);
  EXPECT_THAT(stream.str(), HasSubstr("1000/1000 frames"));
  EXPECT_THAT(stream.str(), HasSubstr("100%"));
}

TEST(ProgressBar, counts_beyond_the_total_and_empty_tasks_are_harmless) {
  std::ostringstream stream;
  ProgressBar bar(stream, true, "render", "frames", 0);
  bar.update(5);
  EXPECT_THAT(stream.str(), HasSubstr("1/1 frames"));
}

TEST(ProgressBar, bars_grow_by_eighths_of_a_cell) {
  EXPECT_EQ(bar_text(0, 4), "    ");
  EXPECT_EQ(bar_text(1, 4), "████");
  EXPECT_EQ(bar_text(0.5, 4), "██  ");
  EXPECT_EQ(bar_text(1.0 / 8, 4), "▌   ");
  EXPECT_EQ(bar_text(0.999, 1), "▉");
  EXPECT_EQ(bar_text(-1, 2), "  ");
  EXPECT_EQ(bar_text(2, 2), "██");
}

TEST(ProgressBar, durations_round_up_to_seconds) {
  EXPECT_EQ(duration_text(seconds(0)), "0:00");
  EXPECT_EQ(duration_text(milliseconds(6100)), "0:07");
  EXPECT_EQ(duration_text(seconds(750)), "12:30");
  EXPECT_EQ(duration_text(seconds(3 * 3600 + 5 * 60)), "3:05:00");
  EXPECT_EQ(duration_text(seconds(-5)), "0:00");
}

}  // namespace
}  // namespace lightloom
