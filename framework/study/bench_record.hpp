#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "framework/gpu/device.hpp"
#include "framework/graph/plan.hpp"
#include "framework/scene/scene.hpp"
#include "framework/study/bench.hpp"
#include "framework/study/device_rates.hpp"
#include "framework/study/floors.hpp"
#include "framework/study/statistics.hpp"

namespace lightloom::study {

/// All that one call of `lightloom bench` finds.
struct BenchRecord {
  std::vector<std::string> command_line;
  gpu::DeviceInfo device;
  BenchSettings settings;
  double scene_ms = 0;             ///< reading the scene
  double device_ms = 0;            ///< opening the device
  std::vector<BenchFigures> runs;  ///< one or two
  std::vector<Plan> plans;         ///< of the runs
  BenchMemory memory;
  std::optional<DeviceRates> rates;              ///< where floors are wanted
  std::vector<std::vector<PassFloor>> floors{};  ///< of the runs, there
};

/// How the first run stands to the second, by the times of the frames that ran side by side.
struct BenchComparison {
  RatioEstimate frame;
  std::vector<std::pair<std::string, RatioEstimate>> passes;  ///< that both have, in the first one's order
};
[[nodiscard]] BenchComparison compare_runs(const BenchFigures& first, const BenchFigures& second);

/// Sum over passes of a frame [ms]: what frames cost whose passes are timed alone. Empty without timestamps.
[[nodiscard]] std::vector<double> sums_of_passes(const BenchFigures& figures);

/// Rays or steps of a frame over the median time of the passes that marched them [1/s]; 0 where that is not known.
[[nodiscard]] double per_second(double count, const BenchFigures& figures);

/// `frame_ms` {median, p95, samples}, `passes` {NAME: {median, p95, samples}}, `once`, `memory`, `rays` and `floors`
/// of the first run; the same of the second under `against`; `comparison`, first over second; and `device_rates`.
[[nodiscard]] nlohmann::ordered_json bench_json(const BenchRecord& record, const scene::Scene& scene);

}  // namespace lightloom::study
