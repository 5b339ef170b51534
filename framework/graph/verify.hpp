#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "framework/graph/plan.hpp"
#include "framework/graph/share_memory.hpp"

namespace lightloom {

/// Memory that a plan's values lie in, as share_memory placed them; without it every value has memory of its own.
struct PlannedMemory {
  const MemorySharing* sharing = nullptr;
  std::span<const MemoryNeed> needs;  ///< one entry a value
};

/// What a verification looked at.
struct Verification {
  std::vector<std::string> violations;  ///< a sentence each, at most as many as asked for
  uint64_t frames = 0;                  ///< that were played
  uint64_t accesses = 0;
  uint64_t barriers = 0;
  uint64_t pairs = 0;  ///< of accesses to the same memory that had to be ordered, without those that follow from others
};

/// Checks a plan by another method than its synthesis, and shares no code with it: plays enough frames for every ring
/// to go round, and at least three, as one list of accesses and barriers for each piece of memory, and demands
///   - between each two accesses of which one writes, a chain of barriers on a value that lies in the piece, by
///   Vulkan's
///     scopes of stages and accesses, with the first one's writes made available and then visible;
///   - that each read of age a finds what its value's pass wrote a frames ago, or the clear, and never what is
///   undefined:
///     never written, left over from another value, or discarded when memory was taken over;
///   - that who writes memory that held another value has taken it over before.
/// Barriers on values that lie elsewhere do not count, which is stricter than Vulkan.
[[nodiscard]] Verification verify(const Plan& plan, const PlannedMemory& memory = {}, std::size_t limit = 8);

}  // namespace lightloom
