#include "framework/run/frame_set.hpp"

#include <gtest/gtest.h>

#include <set>

namespace lightloom::run {
namespace {

FrameSet parsed(const std::string& text) {
  FrameSet set;
  EXPECT_EQ(parse_frame_set(text, set), "") << text;
  return set;
}

std::set<uint32_t> members(const FrameSet& set, uint32_t end) {
  std::set<uint32_t> found;
  for (uint32_t frame = 0; frame < end; ++frame)
    if (set.contains(frame)) found.insert(frame);
  return found;
}

TEST(FrameSetTest, NoSpansAreEveryFrame) {
  EXPECT_EQ(members({}, 4), (std::set<uint32_t>{0, 1, 2, 3}));
  EXPECT_TRUE(FrameSet{}.meets(7, 7));
  EXPECT_EQ(to_string(FrameSet{}), "all");
}

TEST(FrameSetTest, SpansNumbersAndSteps) {
  EXPECT_EQ(members(parsed("5"), 10), (std::set<uint32_t>{5}));
  EXPECT_EQ(members(parsed("0..3,10,20..45:10"), 60), (std::set<uint32_t>{0, 1, 2, 3, 10, 20, 30, 40}));
  EXPECT_EQ(members(parsed("3..:4"), 13), (std::set<uint32_t>{3, 7, 11}));
  EXPECT_EQ(members(parsed("8.."), 11), (std::set<uint32_t>{8, 9, 10}));
}

TEST(FrameSetTest, TheTextIsTheSameAgain) {
  for (const char* text : {"5", "0..3,10,20..45:10", "3..:4", "8..", "99..9999:100"})
    EXPECT_EQ(to_string(parsed(text)), text);
}

TEST(FrameSetTest, MeetsARangeThatHasAMember) {
  const FrameSet set = parsed("3..20:5,40");
  for (uint32_t first = 0; first < 50; ++first)
    for (uint32_t last = first; last < 50; ++last) {
      bool any = false;
      for (uint32_t frame = first; frame <= last; ++frame)
        any = any || frame == 40 || (frame >= 3 && frame <= 20 && (frame - 3) % 5 == 0);
      EXPECT_EQ(set.meets(first, last), any) << first << ".." << last;
    }
  EXPECT_TRUE(parsed("4294967295").contains(4294967295U));
  EXPECT_FALSE(parsed("0..:4294967295").meets(1, 4294967294U)) << "no overflow";
}

TEST(FrameSetTest, WhatIsNoSetOfFramesIsSaid) {
  for (const char* text : {"", ",", "1,", "a", "3..1", "1..5:0", "1..5:", ":3", "..5", "1...5", "-1", "1.5", "1..5:2:2",
                           "4294967296", " 1"}) {
    FrameSet set{{{7, 7, 1}}};
    EXPECT_NE(parse_frame_set(text, set).find("expected frames such as"), std::string::npos) << text;
    EXPECT_EQ(set, (FrameSet{{{7, 7, 1}}})) << "left alone";
  }
}

}  // namespace
}  // namespace lightloom::run
