#include "framework/study/time_estimate.hpp"

#include <algorithm>

namespace lightloom::study {

void TimeEstimate::add(size_t kind, double seconds) {
  Sum& sum = kinds_[kind];
  sum.seconds += seconds;
  ++sum.count;
}

std::optional<double> TimeEstimate::of(size_t kind) const {
  if (kinds_.empty()) return std::nullopt;
  if (const auto found = kinds_.find(kind); found != kinds_.end())
    return found->second.seconds / static_cast<double>(found->second.count);
  // Every kind counts once, so that the ones done most often do not stand for the others.
  double means = 0;
  for (const auto& [other, sum] : kinds_) means += sum.seconds / static_cast<double>(sum.count);
  return means / static_cast<double>(kinds_.size());
}

std::optional<double> TimeEstimate::left(const std::vector<size_t>& kinds, size_t at_a_time) const {
  if (kinds_.empty() && !kinds.empty()) return std::nullopt;
  double seconds = 0;
  double longest = 0;
  for (const size_t kind : kinds) {
    const double one = of(kind).value_or(0);
    seconds += one;
    longest = std::max(longest, one);
  }
  return std::max(longest, seconds / static_cast<double>(std::max<size_t>(at_a_time, 1)));
}

}  // namespace lightloom::study
