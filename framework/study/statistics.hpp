#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "framework/study/results.hpp"

namespace lightloom::study {

/// Quantile of Student's t distribution: t with P(T <= t) = `probability`, for 0 < probability < 1 and 1 or more
/// degrees of freedom. By bisection of the distribution function, which is a regularised incomplete beta function
/// (Abramowitz and Stegun 26.7.1), to a relative 1e-12.
[[nodiscard]] double student_t_quantile(double probability, double degrees_of_freedom);

/// Mean, standard deviation (of the sample, n - 1) and 95 % confidence interval of the mean. One sample has no
/// interval: low = high = mean. Where a sample is not finite the mean is what IEEE 754 makes of it, without an
/// interval.
[[nodiscard]] Estimate estimate(std::span<const double> samples);

/// Row against baseline, paired: entry i of both has the same seed. The difference is within the noise if its interval
/// holds 0, or if there is one pair alone and it does not vanish. Equal samples are within the noise too. The shorter
/// list decides how many pairs there are.
[[nodiscard]] Verdict compare_paired(std::span<const double> row, std::span<const double> baseline);

/// Median of ratios of paired times.
struct RatioEstimate {
  double median = 1;
  double low = 1;  ///< of an interval that holds the true median with 95 % or more, whatever the distribution
  double high = 1;
  uint32_t pairs = 0;
  bool within_noise = true;  ///< the interval holds 1, or there are fewer than the 6 pairs that an interval takes
};

/// Of numerator[i] / denominator[i], all positive; the shorter list decides how many pairs there are. The interval is
/// that of the sign test, between two order statistics, so that a few disturbed frames cannot move it far.
[[nodiscard]] RatioEstimate paired_ratio(std::span<const double> numerator, std::span<const double> denominator);

/// Linear interpolation between order statistics (Hyndman and Fan's type 7, NumPy's default); `fraction` within 0 and
/// 1, where 0.5 is the median. 0 for none.
[[nodiscard]] double percentile(std::vector<double> values, double fraction);

/// Median and 95th percentile.
[[nodiscard]] Timing timing_of(const std::vector<double>& milliseconds);

struct ErrorSplit {
  Estimate bias_squared;
  Estimate variance;
};

/// Mean square error split into bias and noise. `products` is a K x K matrix, row by row: entry i, j is the mean over
/// pixels and channels of (x_i - r)(x_j - r), x_i the image of seed i, r the reference. Products of different seeds
/// have the expectation bias^2, squares have bias^2 + variance. So, unbiased and therefore a little below 0 at times,
///   bias^2   = (sum of all entries - trace) / (K (K - 1)) = |mean - r|^2 - variance / K
///   variance = trace / K - bias^2.
/// Intervals by the jackknife over seeds, K >= 3. With K = 1 nothing can be told apart: both are zero with count 0.
[[nodiscard]] ErrorSplit split_error(std::span<const double> products, size_t seeds);

struct Point {
  double milliseconds = 0;
  double error = 0;
};

/// Which points no other one dominates: none is at least as good in both and better in one. Equal points stand
/// together. Points that are not finite are never on the front.
[[nodiscard]] std::vector<bool> pareto_front(std::span<const Point> points);

}  // namespace lightloom::study
