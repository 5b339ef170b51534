#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "framework/gpu/result.hpp"

namespace lightloom::run {

/// A frame in which the device was lost.
struct LostFrame {
  uint32_t frame = 0;
  std::vector<std::string> passes;           ///< in the order in which the frame runs them
  std::optional<std::vector<bool>> written;  ///< for each pass, whether it began and whether it ended: two entries each
};

/// What went wrong, with the frame and the pass that was under way, as far as the device's timestamps tell.
[[nodiscard]] gpu::DeviceLost in_frame(const gpu::DeviceLost& lost, const LostFrame& frame);

/// What stands in a run folder whose run lost the device.
struct KeptFrames {
  uint32_t first = 0;       ///< number of the run's first frame
  uint32_t written = 0;     ///< whole frames
  uint32_t checkpoint = 0;  ///< frames before the last checkpoint; 0: there is none
  std::string folder;
};

/// The same with what is kept, and how to go on.
[[nodiscard]] gpu::DeviceLost with_kept(const gpu::DeviceLost& lost, const KeptFrames& kept);

}  // namespace lightloom::run
