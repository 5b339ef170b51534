#include "framework/graph/critical_path.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>

namespace lightloom {
namespace {

std::string decimal(const char* format, double value) {
  std::array<char, 48> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, value);
  return buffer.data();
}

}  // namespace

std::vector<std::vector<uint32_t>> steps_before(const Plan& plan) {
  std::vector<std::optional<uint32_t>> writer(plan.graph.values.size());
  std::vector<std::vector<uint32_t>> before(plan.steps.size());
  for (uint32_t index = 0; index < plan.steps.size(); ++index) {
    const GraphPass& pass = plan.graph.passes[plan.steps[index].pass];
    for (const Use& use : pass.inputs)
      if (use.first_age == 0 && writer[use.value]) before[index].push_back(*writer[use.value]);
    std::sort(before[index].begin(), before[index].end());
    before[index].erase(std::unique(before[index].begin(), before[index].end()), before[index].end());
    for (const auto* uses : {&pass.outputs, &pass.scratch})
      for (const Use& use : *uses) writer[use.value] = index;
  }
  return before;
}

CriticalPath critical_path(const Plan& plan, std::span<const double> step_ms) {
  CriticalPath path;
  const std::vector<std::vector<uint32_t>> before = steps_before(plan);
  std::vector<std::optional<uint32_t>> waits_for(before.size());
  std::vector<double> end(before.size(), 0);
  std::optional<uint32_t> last;
  for (uint32_t step = 0; step < before.size(); ++step) {
    double start = 0;
    for (const uint32_t earlier : before[step]) {
      if (waits_for[step] && end[earlier] <= start) continue;
      start = end[earlier];
      waits_for[step] = earlier;
    }
    path.earliest_ms.push_back(start);
    end[step] = start + step_ms[step];
    path.sum_ms += step_ms[step];
    if (!last || end[step] > end[*last]) last = step;
  }
  for (std::optional<uint32_t> step = last; step; step = waits_for[*step]) path.steps.push_back(*step);
  std::reverse(path.steps.begin(), path.steps.end());
  if (last) path.length_ms = end[*last];
  return path;
}

std::string print_critical_path(const Plan& plan, std::span<const double> step_ms) {
  const CriticalPath path = critical_path(plan, step_ms);
  const double gain = path.sum_ms - path.length_ms;
  std::string text = "\ncritical path " + decimal("%.2f ms", path.length_ms) + " of " +
                     decimal("%.2f ms", path.sum_ms) + ": overlapping passes can save at most " +
                     decimal("%.2f ms", gain) + decimal(" (%.1f %%)\n", path.sum_ms > 0 ? 100 * gain / path.sum_ms : 0);
  for (const uint32_t step : path.steps)
    text += decimal("  %10.3f ms  ", step_ms[step]) + plan.graph.passes[plan.steps[step].pass].name + "\n";
  return text;
}

}  // namespace lightloom
