#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "framework/graph/plan.hpp"
#include "framework/graph/traffic.hpp"
#include "framework/study/bench.hpp"
#include "framework/study/device_rates.hpp"

namespace lightloom::study {

/// The least time that a device needs for a pass, by what the pass has to do and what the device does at best. Each
/// figure alone is a bound, so the largest is the floor. All times in ms.
struct PassFloor {
  std::string pass;
  uint64_t bytes_read = 0;  ///< traffic_of
  uint64_t bytes_written = 0;
  double bytes_ms = 0;     ///< these bytes at the rate of large copies
  double texels_ms = 0;    ///< its texels, format by format, at the rates of loads and stores; 0 for host passes
  double steps_ms = 0;     ///< the steps of its rays, where it counts them, at the rate of marching fetches
  double dispatch_ms = 0;  ///< that of one group
  double measured_ms = 0;  ///< median; 0 where the device has no timestamps
  [[nodiscard]] double floor_ms() const;
  [[nodiscard]] std::string_view bound() const;  ///< which one it is: "bytes", "texels", "steps", "dispatch"
  [[nodiscard]] double ratio() const;            ///< measured over floor
};

/// Formats of what the passes of every frame read and write.
[[nodiscard]] std::set<Format> formats_of(const Plan& plan);

/// Of the passes that every frame runs, in order. Steps by `figures.rays`, at the rate for the volume whose size is
/// nearest to that of the r8_unorm volume which the pass reads.
[[nodiscard]] std::vector<PassFloor> floors_of(const Plan& plan, const BenchFigures& figures, const DeviceRates& rates);

[[nodiscard]] nlohmann::ordered_json floors_json(const std::vector<PassFloor>& floors);

}  // namespace lightloom::study
