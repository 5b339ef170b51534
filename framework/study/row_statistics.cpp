#include "framework/study/row_statistics.hpp"

#include <algorithm>
#include <numeric>
#include <set>

#include "framework/study/statistics.hpp"

namespace lightloom::study {
namespace {

std::vector<double> timed(const std::vector<double>& frames, uint32_t warm_up) {
  return {frames.begin() + std::min<std::ptrdiff_t>(warm_up, std::ssize(frames)), frames.end()};
}

bool has_timestamps(const CellTimes& times) {
  return std::all_of(times.frames.begin(), times.frames.end(), [](const std::vector<double>& passes) {
    return std::all_of(passes.begin(), passes.end(), [](double time) { return time >= 0; });
  });
}

/// Hoisted passes first, as they run, then those of every frame.
std::vector<PassTiming> pass_timings(const RowSamples& samples, uint32_t warm_up) {
  std::vector<PassTiming> timings;
  const CellTimes& first = samples.cells.front().times;
  for (size_t i = 0; i < first.once.size(); ++i) {
    std::vector<double> times;
    for (const CellRecord& cell : samples.cells) times.push_back(cell.times.once.at(i).second);
    timings.push_back({first.once[i].first, {}, percentile(times, 0.5), true});
  }
  for (size_t pass = 0; pass < first.passes.size(); ++pass) {
    std::vector<double> times;
    for (const CellRecord& cell : samples.cells)
      for (size_t frame = warm_up; frame < cell.times.frames.size(); ++frame)
        times.push_back(cell.times.frames[frame].at(pass));
    timings.push_back({first.passes[pass], timing_of(times), 0, false});
  }
  return timings;
}

std::set<std::string> pass_names(const Plan& plan) {
  std::set<std::string> names;
  for (const GraphPass& pass : plan.graph.passes) names.insert(pass.name);
  return names;
}

}  // namespace

std::vector<double> frame_times(const CellTimes& times, uint32_t warm_up) {
  if (!has_timestamps(times)) return {};
  std::vector<double> sums;
  for (const std::vector<double>& passes : times.frames)
    sums.push_back(std::accumulate(passes.begin(), passes.end(), 0.0));
  return timed(sums, warm_up);
}

std::vector<double> frame_medians(const RowSamples& samples, uint32_t warm_up) {
  std::vector<double> medians;
  for (const CellRecord& cell : samples.cells) medians.push_back(percentile(frame_times(cell.times, warm_up), 0.5));
  return medians;
}

std::vector<double> values_of(const RowSamples& samples, const std::string& metric) {
  std::vector<double> values;
  for (const MetricValues& metrics : samples.metrics) values.push_back(metrics.at(metric));
  return values;
}

void fill_measurements(Row& row, const RowSamples& samples, const std::vector<std::string>& metrics, uint32_t warm_up) {
  for (const std::string& metric : metrics) row.metrics[metric] = estimate(values_of(samples, metric));
  row.frame_ms = estimate(frame_medians(samples, warm_up));
  std::vector<double> frames;
  std::vector<double> walls;
  std::vector<double> firsts;
  for (const CellRecord& cell : samples.cells) {
    const std::vector<double> times = frame_times(cell.times, warm_up);
    const std::vector<double> wall = timed(cell.times.wall, warm_up);
    frames.insert(frames.end(), times.begin(), times.end());
    walls.insert(walls.end(), wall.begin(), wall.end());
    firsts.push_back(cell.times.wall.front());
    row.disturbed = row.disturbed || cell.jobs > 1;
  }
  row.frame = timing_of(frames);
  row.wall = timing_of(walls);
  row.first_frame_ms = percentile(firsts, 0.5);
  row.passes = pass_timings(samples, warm_up);
  for (const PassTiming& pass : row.passes) row.once_ms += std::max(pass.once, 0.0);
  row.memory_bytes = samples.cells.front().times.memory_bytes;
}

void fill_verdicts(Row& row, const RowSamples& samples, const RowSamples& baseline,
                   const std::vector<std::string>& metrics, uint32_t warm_up) {
  for (const std::string& metric : metrics)
    row.verdicts[metric] = compare_paired(values_of(samples, metric), values_of(baseline, metric));
  row.verdicts["frame_ms"] = compare_paired(frame_medians(samples, warm_up), frame_medians(baseline, warm_up));
}

void fill_missing_passes(Row& row, const Plan& plan, const Plan& baseline) {
  const std::set<std::string> runs = pass_names(plan);
  std::set<std::string> already;
  for (const PassRemark& remark : baseline.graph.bypassed) already.insert(remark.pass);
  std::set<std::string> disabled;
  for (const PassRemark& remark : plan.graph.bypassed)
    if (!already.contains(remark.pass)) {
      row.disabled.push_back(remark.pass);
      disabled.insert(remark.pass);
    }
  for (const GraphPass& pass : baseline.graph.passes)
    if (!runs.contains(pass.name) && !disabled.contains(pass.name)) row.culled.push_back(pass.name);
}

}  // namespace lightloom::study
