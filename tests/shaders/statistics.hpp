#pragma once

#include <cmath>
#include <vector>

namespace lightloom::test {

struct ChiSquare {
  double statistic = 0;
  int degrees = 0;
  double p_value = 1;  ///< probability of a statistic at least as large if the expectation is right
};

/// Pearson's test; cells expected to hold fewer than five samples are pooled. The p-value is Wilson and Hilferty's.
inline ChiSquare chi_square(const std::vector<double>& observed, const std::vector<double>& expected) {
  ChiSquare result;
  double pooled_observed = 0, pooled_expected = 0;
  int cells = 0;
  for (size_t k = 0; k < observed.size(); ++k) {
    if (expected[k] < 5) {
      pooled_observed += observed[k];
      pooled_expected += expected[k];
      continue;
    }
    result.statistic += (observed[k] - expected[k]) * (observed[k] - expected[k]) / expected[k];
    ++cells;
  }
  if (pooled_expected >= 5) {
    result.statistic += (pooled_observed - pooled_expected) * (pooled_observed - pooled_expected) / pooled_expected;
    ++cells;
  } else if (pooled_observed > 40) {
    result.statistic += 1e9;  // far more samples than could be where none should be
  }
  result.degrees = cells - 1;
  const double n = result.degrees;
  const double z = (std::cbrt(result.statistic / n) - (1 - 2 / (9 * n))) / std::sqrt(2 / (9 * n));
  result.p_value = 0.5 * std::erfc(z / std::sqrt(2.0));
  return result;
}

}  // namespace lightloom::test
