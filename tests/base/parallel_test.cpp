#include "framework/base/parallel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <vector>

namespace lightloom {
namespace {

TEST(ParallelRuns, cover_every_index_once) {
  for (const unsigned threads : {0u, 1u, 2u, 3u, 7u, 64u}) {
    for (const size_t count : {size_t{0}, size_t{1}, size_t{2}, size_t{5}, size_t{1000}}) {
      std::vector<std::atomic<int>> visits(count);
      std::atomic<size_t> calls = 0;
      parallel_runs(count, threads, [&](size_t begin, size_t end) {
        EXPECT_LT(begin, end);
        ++calls;
        for (size_t k = begin; k < end; ++k) ++visits.at(k);
      });
      for (const std::atomic<int>& visit : visits) EXPECT_EQ(visit, 1);
      EXPECT_LE(calls, std::max<size_t>(count, 1));
      if (threads > 0) {
        EXPECT_EQ(calls, std::min<size_t>(threads, count));
      }
    }
  }
}

TEST(ParallelRuns, throw_what_the_first_run_threw_after_all_have_ended) {
  std::atomic<int> ended = 0;
  try {
    parallel_runs(4, 4, [&](size_t begin, size_t) {
      ++ended;
      if (begin > 0) throw std::runtime_error("run " + std::to_string(begin));
    });
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "run 1");
  }
  EXPECT_EQ(ended, 4);
}

}  // namespace
}  // namespace lightloom
