#include "framework/run/triangle_ranges.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <random>
#include <string>

namespace lightloom::run {
namespace {

using Ranges = std::vector<TriangleRange>;

Ranges of(const std::string& kinds, size_t limit) {
  return ranges_of(
      static_cast<uint32_t>(kinds.size()), [&](uint32_t t) { return kinds[t] == 'x'; }, limit);
}

TEST(TriangleRanges, AreTheRunsWhereThereAreFew) {
  EXPECT_EQ(of("xx..x.", 2), (Ranges{{0, 2}, {4, 1}}));
  EXPECT_EQ(of(".xx", 1), (Ranges{{1, 2}}));
  EXPECT_EQ(of("...", 1), Ranges{});
  EXPECT_EQ(of("", 1), Ranges{});
}

TEST(TriangleRanges, TakeTheShortestGapsAlongWhereThereAreMany) {
  EXPECT_EQ(of("x.x..x...x", 2), (Ranges{{0, 6}, {9, 1}}));
  EXPECT_EQ(of("x..x.x", 2), (Ranges{{0, 1}, {3, 3}}));
  EXPECT_EQ(of("x.x.x.x", 2).size(), 2u) << "gaps of one length";
  EXPECT_EQ(of("x..x.x", 1), (Ranges{{0, 6}}));
}

/// Against all ways to cut a short list into ranges.
TEST(TriangleRanges, HoldAllThatIsWantedAndAsFewOthersAsCanBe) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    std::string kinds(10, '.');
    for (char& kind : kinds)
      if (random() % 3 == 0) kind = 'x';
    for (size_t limit = 1; limit <= 4; ++limit) {
      SCOPED_TRACE(kinds + " in " + std::to_string(limit));
      uint32_t held = 0, end = 0;
      std::string covered(10, '.');
      const Ranges ranges = of(kinds, limit);
      ASSERT_LE(ranges.size(), limit);
      for (const TriangleRange& range : ranges) {
        ASSERT_GE(range.first, end);
        end = range.first + range.count;
        held += range.count;
        for (uint32_t t = range.first; t < end; ++t) covered.at(t) = 'x';
      }
      uint32_t least = 11;
      for (uint32_t bits = 0; bits < 1024; ++bits) {
        bool all = true;
        size_t runs = 0;
        for (uint32_t t = 0; t < 10; ++t) {
          const bool in = (bits >> t & 1) != 0;
          all = all && (in || kinds[t] != 'x');
          if (in && (t == 0 || (bits >> (t - 1) & 1) == 0)) ++runs;
        }
        if (all && runs <= limit) least = std::min(least, static_cast<uint32_t>(std::popcount(bits)));
      }
      EXPECT_EQ(held, least);
      for (size_t t = 0; t < 10; ++t) EXPECT_TRUE(kinds[t] != 'x' || covered[t] == 'x');
    }
  }
}

}  // namespace
}  // namespace lightloom::run
