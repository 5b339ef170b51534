#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lightloom::stability {

/// Probability that Pearson's chi-square statistic of counts whose expectation is the same in each cell is at least as
/// large by chance (Wilson and Hilferty 1931). 0 for fewer than two cells.
[[nodiscard]] double uniformity_chance(std::span<const double> counts);

/// Correlation of two rows of equal length, -1 to 1; 0 where one of them is constant.
[[nodiscard]] double correlation(std::span<const double> a, std::span<const double> b);

/// Mean of independent numbers and its standard error (Welford 1962).
class SampleMean {
 public:
  void add(double value);
  [[nodiscard]] size_t count() const { return count_; }
  [[nodiscard]] double mean() const { return mean_; }
  [[nodiscard]] double variance() const { return spread_ / static_cast<double>(count_ - 1); }  ///< of one number
  [[nodiscard]] double error() const;                                                          ///< of the mean

 private:
  size_t count_ = 0;
  double mean_ = 0;
  double spread_ = 0;
};

/// Slope of the straight line through points, by least squares.
[[nodiscard]] double slope(std::span<const double> x, std::span<const double> y);

}  // namespace lightloom::stability
