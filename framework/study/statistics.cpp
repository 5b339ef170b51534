#include "framework/study/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lightloom::study {
namespace {

constexpr double kConfidence = 0.95;

/// Continued fraction of the incomplete beta function (Abramowitz and Stegun 26.5.8), by the modified method of Lentz.
double beta_fraction(double a, double b, double x) {
  constexpr double kTiny = 1e-300;
  constexpr double kPrecision = 1e-16;
  constexpr int kMostTerms = 10'000;
  const auto not_zero = [](double value) { return std::abs(value) < kTiny ? kTiny : value; };
  double c = 1;
  double d = 1 / not_zero(1 - (a + b) * x / (a + 1));
  double result = d;
  for (int term = 1; term < kMostTerms; ++term) {
    const double m = term;
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    d = 1 / not_zero(1 + even * d);
    c = not_zero(1 + even / c);
    result *= c * d;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    d = 1 / not_zero(1 + odd * d);
    c = not_zero(1 + odd / c);
    const double factor = c * d;
    result *= factor;
    if (std::abs(factor - 1) < kPrecision) break;
  }
  return result;
}

/// Regularised incomplete beta function I_x(a, b).
double incomplete_beta(double a, double b, double x) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  const double scale =
      std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x));
  // The fraction converges fast on one side of the mean; the other follows by symmetry.
  if (x < (a + 1) / (a + b + 2)) return scale * beta_fraction(a, b, x) / a;
  return 1 - scale * beta_fraction(b, a, 1 - x) / b;
}

/// P(T > t) for t >= 0.
double upper_tail(double t, double degrees_of_freedom) {
  return 0.5 * incomplete_beta(degrees_of_freedom / 2, 0.5, degrees_of_freedom / (degrees_of_freedom + t * t));
}

double sum(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

Estimate with_interval(double mean, double standard_deviation, double standard_error, size_t count) {
  const double half = student_t_quantile(0.5 + kConfidence / 2, static_cast<double>(count - 1)) * standard_error;
  return {mean, mean - half, mean + half, standard_deviation, static_cast<uint32_t>(count)};
}

/// bias^2 and variance from the products of the seeds but for `left_out`.
std::pair<double, double> split_without(std::span<const double> products, size_t seeds, size_t left_out) {
  double all = 0;
  double trace = 0;
  double count = 0;
  for (size_t i = 0; i < seeds; ++i) {
    if (i == left_out) continue;
    ++count;
    trace += products[i * seeds + i];
    for (size_t j = 0; j < seeds; ++j)
      if (j != left_out) all += products[i * seeds + j];
  }
  const double bias_squared = (all - trace) / (count * (count - 1));
  return {bias_squared, trace / count - bias_squared};
}

/// `deviations`: the estimate without each seed in turn.
Estimate jackknife(double value, const std::vector<double>& without) {
  const auto count = static_cast<double>(without.size());
  const double mean = sum(without) / count;
  double squares = 0;
  for (const double one : without) squares += (one - mean) * (one - mean);
  const double standard_error = std::sqrt((count - 1) / count * squares);
  return with_interval(value, standard_error * std::sqrt(count), standard_error, without.size());
}

/// Largest k for which fewer than k heads in `count` throws of a coin have a probability of 2.5 % at most: the k-th
/// values from both ends of a sorted sample then hold the median between them in 95 % of samples or more. 0: there is
/// none.
size_t sign_test_tail(size_t count) {
  const auto n = static_cast<double>(count);
  double tail = 0;
  size_t k = 0;
  while (2 * k < count) {
    const auto heads = static_cast<double>(k);
    const double ways = std::lgamma(n + 1) - std::lgamma(heads + 1) - std::lgamma(n - heads + 1);
    tail += std::exp(ways - n * std::log(2.0));
    if (tail > 0.025) break;
    ++k;
  }
  return k;
}

}  // namespace

double student_t_quantile(double probability, double degrees_of_freedom) {
  if (probability < 0.5) return -student_t_quantile(1 - probability, degrees_of_freedom);
  const double tail = 1 - probability;
  double low = 0;
  double high = 1;
  while (upper_tail(high, degrees_of_freedom) > tail && high < 1e300) high *= 2;
  while (high - low > 1e-12 * high) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (upper_tail(middle, degrees_of_freedom) > tail ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Estimate estimate(std::span<const double> samples) {
  if (samples.empty()) return {};
  const auto count = static_cast<double>(samples.size());
  const double mean = sum(samples) / count;
  if (samples.size() == 1 || !std::isfinite(mean)) return {mean, mean, mean, 0, static_cast<uint32_t>(samples.size())};
  double squares = 0;
  for (const double sample : samples) squares += (sample - mean) * (sample - mean);
  const double deviation = std::sqrt(squares / (count - 1));
  return with_interval(mean, deviation, deviation / std::sqrt(count), samples.size());
}

Verdict compare_paired(std::span<const double> row, std::span<const double> baseline) {
  const size_t pairs = std::min(row.size(), baseline.size());
  Verdict verdict;
  if (pairs == 0) return verdict;
  std::vector<double> differences;
  for (size_t i = 0; i < pairs; ++i) differences.push_back(row[i] == baseline[i] ? 0 : row[i] - baseline[i]);
  verdict.difference = estimate(differences);
  const double divisor = sum(baseline.first(pairs));
  const double dividend = sum(row.first(pairs));
  verdict.ratio = dividend == divisor ? 1 : dividend / divisor;
  verdict.within_noise = pairs == 1 || !std::isfinite(verdict.difference.mean) ||
                         (verdict.difference.low <= 0 && verdict.difference.high >= 0);
  return verdict;
}

RatioEstimate paired_ratio(std::span<const double> numerator, std::span<const double> denominator) {
  std::vector<double> ratios;
  for (size_t i = 0; i < std::min(numerator.size(), denominator.size()); ++i)
    ratios.push_back(numerator[i] / denominator[i]);
  if (ratios.empty()) return {};
  std::sort(ratios.begin(), ratios.end());
  const size_t outside = sign_test_tail(ratios.size());
  RatioEstimate result{percentile(ratios, 0.5), ratios.front(), ratios.back(), static_cast<uint32_t>(ratios.size()),
                       true};
  if (outside == 0) return result;
  result.low = ratios[outside - 1];
  result.high = ratios[ratios.size() - outside];
  result.within_noise = result.low <= 1 && result.high >= 1;
  return result;
}

double percentile(std::vector<double> values, double fraction) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const double place = fraction * static_cast<double>(values.size() - 1);
  const auto below = static_cast<size_t>(place);
  const size_t above = std::min(below + 1, values.size() - 1);
  const double part = place - static_cast<double>(below);
  return part == 0 ? values[below] : values[below] + part * (values[above] - values[below]);
}

Timing timing_of(const std::vector<double>& milliseconds) {
  return {percentile(milliseconds, 0.5), percentile(milliseconds, 0.95)};
}

ErrorSplit split_error(std::span<const double> products, size_t seeds) {
  if (seeds < 2) return {};
  const auto [bias_squared, variance] = split_without(products, seeds, seeds);
  const auto bare = [&](double value) { return Estimate{value, value, value, 0, static_cast<uint32_t>(seeds)}; };
  if (seeds < 3) return {bare(bias_squared), bare(variance)};
  std::vector<double> biases;
  std::vector<double> variances;
  for (size_t left_out = 0; left_out < seeds; ++left_out) {
    const auto [bias, noise] = split_without(products, seeds, left_out);
    biases.push_back(bias);
    variances.push_back(noise);
  }
  return {jackknife(bias_squared, biases), jackknife(variance, variances)};
}

std::vector<bool> pareto_front(std::span<const Point> points) {
  std::vector<bool> front;
  for (const Point& point : points) {
    const bool finite = std::isfinite(point.milliseconds) && std::isfinite(point.error);
    front.push_back(finite && std::none_of(points.begin(), points.end(), [&](const Point& other) {
                      return other.milliseconds <= point.milliseconds && other.error <= point.error &&
                             (other.milliseconds < point.milliseconds || other.error < point.error);
                    }));
  }
  return front;
}

}  // namespace lightloom::study
