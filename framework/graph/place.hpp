#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace lightloom {

/// Memory that something needs from one step of a frame to another.
struct Block {
  uint64_t size = 0;       ///< [bytes]; 0 takes no room
  uint64_t alignment = 1;  ///< of its offset [bytes], a power of two
  uint32_t first = 0;      ///< step in which it is first touched
  uint32_t last = 0;       ///< step in which it is last touched, included; not before `first`
};

/// Where the blocks of one heap lie: two that are live in one step never overlap.
struct Placement {
  std::vector<uint64_t> offsets;  ///< by block [bytes]
  uint64_t heap = 0;              ///< end of the highest block [bytes]
  uint64_t lower_bound = 0;       ///< largest sum of the sizes live in one step [bytes]: no placement needs less
};

/// Places blocks in as little memory as it finds: the best of several orders in which each block goes to the lowest
/// offset that is free, all orders for eight blocks or fewer (which is the optimum, because the blocks of an optimal
/// placement, pushed down in the order of their offsets, are found by that rule). The same blocks give the same
/// placement.
[[nodiscard]] Placement place(std::span<const Block> blocks);

}  // namespace lightloom
