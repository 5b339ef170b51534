#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "framework/image/host_image.hpp"
#include "framework/run/frame_state.hpp"
#include "framework/run/scanned_value.hpp"

namespace lightloom::run {

/// An output or a captured value of one frame.
struct NamedImage {
  std::string name;  ///< the output's name, or "pass.port" / "pass.port.part" of the captured value
  image::HostImage image;
};

struct PassTime {
  std::string pass;
  double milliseconds = 0;  ///< between the device's timestamps around the pass; negative where it has none,
                            ///< or was not asked for them (ExecutorOptions::time_passes).
                            ///< Of a host pass: what it computed, by the host's clock, without the copies
};

/// Under which conditions a frame was made.
struct FrameConditions {
  double time = 0;              ///< of the scene [s]
  uint32_t history_length = 0;  ///< earlier frames that the history rings held
  View view;
  std::vector<glm::vec3> moving_positions;  ///< of the dynamic vertices, in their order [m]
};

/// What of a frame is brought to the host; the rest stays on the device and costs no copy.
struct FrameWants {
  bool outputs = true;   ///< of the graph
  bool captures = true;  ///< of the plan
  bool times = true;     ///< of each pass, where ExecutorOptions::time_passes allows them
};

/// All that one frame gives to the host.
struct FrameResult {
  uint32_t frame = 0;
  FrameConditions conditions;
  std::vector<NamedImage> outputs;    ///< in the order of the graph's outputs
  std::vector<NamedImage> captures;   ///< in the order of the plan's captures
  std::vector<PassTime> times;        ///< of what every frame runs, in execution order
  std::vector<PassTime> once_times;   ///< of what the first frame alone runs; empty in the others
  std::vector<ScannedValue> scanned;  ///< where the plan has scans, in execution order
};

}  // namespace lightloom::run
