#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "framework/run/frame_result.hpp"

namespace lightloom::run {

/// What gathers while frames are rendered. Its size has a bound: of long runs the times of evenly spaced frames are
/// kept, all frames of those up to kMostTimed.
struct RunProgress {
  static constexpr size_t kMostTimed = 1024;

  uint32_t frames_done = 0;
  uint32_t timed_every = 1;                       ///< frames 0, n, 2n, … since the first have their times kept
  std::vector<std::vector<PassTime>> pass_times;  ///< by timed frame
  std::vector<PassTime> once_times;
  std::vector<double> wall_milliseconds;  ///< by timed frame
  std::vector<uint32_t> resumed_at;       ///< frames at which the run went on from a checkpoint

  [[nodiscard]] uint32_t frames() const { return frames_done; }
  /// One more frame is done.
  void add(double milliseconds, const std::vector<PassTime>& times);
};

[[nodiscard]] nlohmann::ordered_json to_json(const RunProgress& progress);
/// Throws nlohmann::json::exception for what `to_json` did not make.
[[nodiscard]] RunProgress progress_from_json(const nlohmann::ordered_json& json);

}  // namespace lightloom::run
