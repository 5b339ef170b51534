#include "framework/run/triangle_ranges.hpp"

#include <algorithm>

namespace lightloom::run {
namespace {

std::vector<TriangleRange> runs_of(uint32_t count, const std::function<bool(uint32_t)>& wanted) {
  std::vector<TriangleRange> runs;
  for (uint32_t t = 0; t < count; ++t) {
    if (!wanted(t)) continue;
    if (!runs.empty() && runs.back().first + runs.back().count == t)
      ++runs.back().count;
    else
      runs.push_back({t, 1});
  }
  return runs;
}

uint32_t gap_after(const TriangleRange& run, const TriangleRange& next) {
  return next.first - run.first - run.count;
}

/// How long a gap must be to part two ranges, and how many gaps of just that length do.
struct GapRule {
  uint32_t length = 0;
  size_t ties = 0;
};

GapRule longest_gaps(const std::vector<TriangleRange>& runs, size_t count) {
  if (count == 0) return {UINT32_MAX, 0};
  std::vector<uint32_t> gaps;
  for (size_t i = 0; i + 1 < runs.size(); ++i) gaps.push_back(gap_after(runs[i], runs[i + 1]));
  const auto last = gaps.begin() + static_cast<std::ptrdiff_t>(count - 1);
  std::nth_element(gaps.begin(), last, gaps.end(), std::greater<>());
  return {*last, static_cast<size_t>(std::count(gaps.begin(), last + 1, *last))};
}

}  // namespace

std::vector<TriangleRange> ranges_of(uint32_t count, const std::function<bool(uint32_t)>& wanted, size_t limit) {
  std::vector<TriangleRange> runs = runs_of(count, wanted);
  if (runs.size() <= limit) return runs;
  GapRule rule = longest_gaps(runs, limit - 1);
  std::vector<TriangleRange> ranges{runs.front()};
  for (size_t i = 1; i < runs.size(); ++i) {
    const uint32_t gap = gap_after(ranges.back(), runs[i]);
    const bool parts = gap > rule.length || (gap == rule.length && rule.ties > 0);
    if (gap == rule.length && rule.ties > 0) --rule.ties;
    if (parts)
      ranges.push_back(runs[i]);
    else
      ranges.back().count = runs[i].first + runs[i].count - ranges.back().first;
  }
  return ranges;
}

}  // namespace lightloom::run
