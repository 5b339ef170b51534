#include "framework/graph/place.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace lightloom {
namespace {

bool fits(const std::vector<Block>& blocks, const std::vector<uint64_t>& offsets) {
  for (size_t i = 0; i < blocks.size(); ++i) {
    if (offsets[i] % blocks[i].alignment != 0) return false;
    for (size_t j = 0; j < i; ++j) {
      const bool apart_in_time = blocks[i].last < blocks[j].first || blocks[j].last < blocks[i].first;
      const bool apart_in_memory =
          offsets[i] + blocks[i].size <= offsets[j] || offsets[j] + blocks[j].size <= offsets[i];
      if (!apart_in_time && !apart_in_memory) return false;
    }
  }
  return true;
}

uint64_t live_bytes(const std::vector<Block>& blocks, uint32_t step) {
  uint64_t sum = 0;
  for (const Block& block : blocks)
    if (block.first <= step && step <= block.last) sum += block.size;
  return sum;
}

/// Can the blocks from `next` on be given offsets below `heap`? Tries every multiple of the alignment.
bool feasible(const std::vector<Block>& blocks, std::vector<uint64_t>& offsets, size_t next, uint64_t heap) {
  if (next == blocks.size()) return true;
  const std::vector<Block> placed(blocks.begin(), blocks.begin() + static_cast<std::ptrdiff_t>(next) + 1);
  for (uint64_t offset = 0; offset + blocks[next].size <= heap; offset += blocks[next].alignment) {
    offsets[next] = offset;
    if (fits(placed, offsets) && feasible(blocks, offsets, next + 1, heap)) return true;
  }
  return false;
}

uint64_t optimum(const std::vector<Block>& blocks) {
  std::vector<uint64_t> offsets(blocks.size());
  for (uint64_t heap = 0;; ++heap)
    if (feasible(blocks, offsets, 0, heap)) return heap;
}

std::vector<Block> random_blocks(std::mt19937& random, size_t count, uint64_t largest, uint32_t steps) {
  std::vector<Block> blocks(count);
  for (Block& block : blocks) {
    block.size = 1 + random() % largest;
    block.alignment = uint64_t{1} << random() % 2;
    const auto a = static_cast<uint32_t>(random() % steps);
    const auto b = static_cast<uint32_t>(random() % steps);
    block.first = std::min(a, b);
    block.last = std::max(a, b);
  }
  return blocks;
}

TEST(Place, nothing_and_empty_blocks_take_no_room) {
  EXPECT_EQ(place({}).heap, 0u);
  const std::vector<Block> empty(3);
  EXPECT_EQ(place(empty).heap, 0u);
  EXPECT_EQ(place(empty).offsets.size(), 3u);
}

TEST(Place, blocks_one_after_another_share_their_memory) {
  const std::vector<Block> chain = {{100, 1, 0, 1}, {100, 1, 1, 2}, {100, 1, 2, 3}, {100, 1, 3, 4}};
  const Placement placement = place(chain);
  EXPECT_EQ(placement.heap, 200u);
  EXPECT_EQ(placement.lower_bound, 200u);
  EXPECT_TRUE(fits(chain, placement.offsets));
}

TEST(Place, small_cases_are_optimal) {
  std::mt19937 random(1);
  uint32_t above_the_bound = 0;
  for (int round = 0; round < 300; ++round) {
    const std::vector<Block> blocks = random_blocks(random, 2 + random() % 5, 5, 6);
    const Placement placement = place(blocks);
    ASSERT_TRUE(fits(blocks, placement.offsets));
    const uint64_t least = optimum(blocks);
    ASSERT_EQ(placement.heap, least) << "round " << round;
    above_the_bound += least > placement.lower_bound ? 1 : 0;
  }
  EXPECT_GT(above_the_bound, 0u) << "no case in which the bound cannot be reached was tried";
}

TEST(Place, many_blocks_never_overlap_and_stay_near_the_bound) {
  std::mt19937 random(2);
  for (int round = 0; round < 20; ++round) {
    const std::vector<Block> blocks = random_blocks(random, 120, 1'000'000, 60);
    const Placement placement = place(blocks);
    ASSERT_TRUE(fits(blocks, placement.offsets));
    uint64_t bound = 0;
    for (uint32_t step = 0; step < 60; ++step) bound = std::max(bound, live_bytes(blocks, step));
    EXPECT_EQ(placement.lower_bound, bound);
    uint64_t heap = 0;
    for (size_t i = 0; i < blocks.size(); ++i) heap = std::max(heap, placement.offsets[i] + blocks[i].size);
    EXPECT_EQ(placement.heap, heap);
    EXPECT_LE(static_cast<double>(heap), 1.05 * static_cast<double>(bound));
  }
}

TEST(Place, the_same_blocks_are_placed_alike) {
  std::mt19937 random(3);
  const std::vector<Block> blocks = random_blocks(random, 40, 1000, 20);
  EXPECT_EQ(place(blocks).offsets, place(blocks).offsets);
}

}  // namespace
}  // namespace lightloom
