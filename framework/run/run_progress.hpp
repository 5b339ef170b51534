#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "framework/run/frame_result.hpp"

namespace lightloom::run {

/// What gathers while frames are rendered.
struct RunProgress {
  std::vector<std::vector<PassTime>> pass_times;  ///< by frame
  std::vector<PassTime> once_times;
  std::vector<double> wall_milliseconds;  ///< by frame
  std::vector<uint32_t> resumed_at;       ///< frames at which the run went on from a checkpoint

  [[nodiscard]] uint32_t frames() const { return static_cast<uint32_t>(wall_milliseconds.size()); }
};

[[nodiscard]] nlohmann::ordered_json to_json(const RunProgress& progress);
/// Throws nlohmann::json::exception for what `to_json` did not make.
[[nodiscard]] RunProgress progress_from_json(const nlohmann::ordered_json& json);

}  // namespace lightloom::run
