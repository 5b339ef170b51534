#include "framework/run/written_files.hpp"

#include <gtest/gtest.h>

namespace lightloom::run {
namespace {

using Names = std::vector<std::filesystem::path>;

TEST(WrittenFiles, GivesEveryName) {
  WrittenFiles files;
  EXPECT_TRUE(files.last_of_frames(".png").empty());
  files.add("plan.json");
  for (const uint32_t frame : {0U, 1U, 2U, 9U, 12345U}) {
    files.add("image.", frame, ".png");
    if (frame != 1) files.add("dumps/", frame, "/a.b.exr");
  }
  files.add("plan.json");
  EXPECT_EQ(files.all(), (Names{"plan.json", "image.0000.png", "image.0001.png", "image.0002.png", "image.0009.png",
                                "image.12345.png", "dumps/0000/a.b.exr", "dumps/0002/a.b.exr", "dumps/0009/a.b.exr",
                                "dumps/12345/a.b.exr"}));
  EXPECT_EQ(files.last_of_frames(".png"), "image.12345.png");
  EXPECT_EQ(WrittenFiles(files.json()).all(), files.all());
}

TEST(WrittenFiles, TakeNoMoreRoomTheMoreFramesThereAre) {
  WrittenFiles few, many;
  for (uint32_t frame = 0; frame < 3; ++frame) few.add("image.", frame, ".png");
  for (uint32_t frame = 0; frame < 1'000'000; ++frame) many.add("image.", frame, ".png");
  EXPECT_LT(many.json().dump().size(), few.json().dump().size() + 16);
}

TEST(FrameText, HasFourDigitsOrMore) {
  EXPECT_EQ(frame_text(0), "0000");
  EXPECT_EQ(frame_text(123), "0123");
  EXPECT_EQ(frame_text(123456), "123456");
}

}  // namespace
}  // namespace lightloom::run
