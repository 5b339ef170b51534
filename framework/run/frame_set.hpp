#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lightloom::run {

/// Frame numbers from `first` to `last`, both inclusive, each `step`-th of them, beginning with `first`.
struct FrameSpan {
  uint32_t first = 0;
  uint32_t last = 0;
  uint32_t step = 1;
  bool operator==(const FrameSpan&) const = default;
};

/// Frames by their numbers. Every frame, unless spans are given.
struct FrameSet {
  std::vector<FrameSpan> spans;

  [[nodiscard]] bool contains(uint32_t frame) const;
  /// Is some frame of first..last in it?
  [[nodiscard]] bool meets(uint32_t first, uint32_t last) const;
  bool operator==(const FrameSet&) const = default;
};

/// Spans apart by commas: a number, FIRST..LAST, FIRST..LAST:STEP, or FIRST.. and FIRST..:STEP without an end. Stores
/// them and returns "", or leaves `set` alone and returns what is wrong.
[[nodiscard]] std::string parse_frame_set(std::string_view text, FrameSet& set);
/// "0..3,10,20..100:10" again; "all" for every frame.
[[nodiscard]] std::string to_string(const FrameSet& set);

}  // namespace lightloom::run
