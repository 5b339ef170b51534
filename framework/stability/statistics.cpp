#include "framework/stability/statistics.hpp"

#include <cmath>
#include <numeric>

namespace lightloom::stability {
namespace {

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Sum of products of the differences from the means.
double shared_spread(std::span<const double> a, std::span<const double> b) {
  const double mean_a = mean_of(a), mean_b = mean_of(b);
  double sum = 0;
  for (size_t k = 0; k < a.size(); ++k) sum += (a[k] - mean_a) * (b[k] - mean_b);
  return sum;
}

}  // namespace

double uniformity_chance(std::span<const double> counts) {
  if (counts.size() < 2) return 0;
  const double expected = mean_of(counts);
  double statistic = 0;
  for (const double count : counts) statistic += (count - expected) * (count - expected) / expected;
  const auto freedom = static_cast<double>(counts.size() - 1);
  const double z = (std::cbrt(statistic / freedom) - (1 - 2 / (9 * freedom))) / std::sqrt(2 / (9 * freedom));
  return 0.5 * std::erfc(z / std::sqrt(2.0));
}

double correlation(std::span<const double> a, std::span<const double> b) {
  const double scale = std::sqrt(shared_spread(a, a) * shared_spread(b, b));
  return scale > 0 ? shared_spread(a, b) / scale : 0;
}

void SampleMean::add(double value) {
  ++count_;
  const double change = value - mean_;
  mean_ += change / static_cast<double>(count_);
  spread_ += change * (value - mean_);
}

double SampleMean::error() const {
  return std::sqrt(variance() / static_cast<double>(count_));
}

double slope(std::span<const double> x, std::span<const double> y) {
  return shared_spread(x, y) / shared_spread(x, x);
}

}  // namespace lightloom::stability
