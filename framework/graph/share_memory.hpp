#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "framework/graph/plan.hpp"

namespace lightloom {

/// What the device says one value's image needs.
struct MemoryNeed {
  uint64_t size = 0;       ///< [bytes]
  uint64_t alignment = 1;  ///< [bytes]
  uint32_t kinds = 0;      ///< bit set of memory types that can hold it; only equal sets share a heap
};

/// Memory that values share within a frame.
struct SharedHeap {
  uint32_t kinds = 0;
  uint64_t bytes = 0;        ///< of the heap
  uint64_t lower_bound = 0;  ///< largest sum of what is live in one step: no sharing needs less
  uint64_t unshared = 0;     ///< sum of its values: what they would need apart
};

/// Where a value lies.
struct SharedPlace {
  uint32_t heap = 0;  ///< index into MemorySharing::heaps
  uint64_t offset = 0;
};

struct MemorySharing {
  std::vector<SharedHeap> heaps;
  std::vector<std::optional<SharedPlace>> places;  ///< by value; empty: it has memory of its own
};

/// Gives values that live within a frame and are not live at the same time the same memory, and adds to the plan what
/// that demands: before the first write of each, a barrier (Barrier::takes_over) that waits for the uses of whoever had
/// the memory last, in this frame or the one before. Histories, persistent values, constants, hoisted ones and outputs
/// of the graph keep memory of their own; a captured value is copied right behind its pass and lives no longer for it.
/// `needs` has one entry a value.
MemorySharing share_memory(Plan& plan, std::span<const MemoryNeed> needs);

}  // namespace lightloom
