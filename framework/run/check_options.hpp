#pragma once

namespace lightloom::run {

/// What a render is to look for in its values; none of it changes a bit of them.
struct CheckOptions {
  bool find_nan = false;     ///< name the passes that make NaN or infinity
  bool stop_at_nan = false;  ///< the same, and end after the frame with the first
  bool poison = false;       ///< name the passes that read, or leave, what nobody wrote
  [[nodiscard]] bool any() const { return find_nan || stop_at_nan || poison; }
};

}  // namespace lightloom::run
