#pragma once

#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

#include "framework/graph/verify.hpp"

namespace lightloom::verification {

constexpr int kPrologue = -1;      ///< frame of the clears
constexpr int kUndefined = -1000;  ///< content that nobody wrote

struct Event {
  enum class Kind : uint8_t { access, barrier, takeover };
  Kind kind = Kind::access;
  ValueId value = 0;
  Access from = Access::none;    ///< of a barrier
  Access access = Access::none;  ///< of an access, or what a barrier leads to
  uint32_t batch = 0;            ///< barriers of one batch are recorded together, and none waits for another
  int frame = kPrologue;
  int content = kPrologue;  ///< reads: the frame whose write is expected
  std::string_view who;     ///< a pass of the plan, which outlives the trace, or a literal
};

/// Events that touch one piece of memory, in order of submission.
using Trace = std::vector<Event>;

/// A piece of memory: a layer of a value with memory of its own, or a range of bytes of a heap.
struct Piece {
  bool in_heap = false;
  uint64_t owner = 0;  ///< value, or heap
  uint64_t place = 0;  ///< layer, or first byte
  auto operator<=>(const Piece&) const = default;
};

/// Plays a plan frame by frame, as many as every ring needs to go round and two more: what happens to each piece of
/// memory. Counts frames, accesses and barriers.
[[nodiscard]] std::map<Piece, Trace> play(const Plan& plan, const PlannedMemory& memory, Verification& counts);

}  // namespace lightloom::verification
