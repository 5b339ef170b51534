#include "framework/study/statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "framework/study/time_estimate.hpp"

namespace lightloom::study {
namespace {

constexpr double kPi = 3.14159265358979323846;

// With 1 and 2 degrees of freedom the distribution has closed forms.
TEST(StudentT, FollowsItsClosedForms) {
  for (const double p : {0.5, 0.6, 0.75, 0.9, 0.975, 0.995, 0.9999}) {
    EXPECT_NEAR(student_t_quantile(p, 1), std::tan(kPi * (p - 0.5)), 1e-9 * (1 + std::tan(kPi * (p - 0.5)))) << p;
    const double two = (2 * p - 1) * std::sqrt(2 / (4 * p * (1 - p)));
    EXPECT_NEAR(student_t_quantile(p, 2), two, 1e-9 * (1 + two)) << p;
  }
}

// Published tables (Fisher and Yates), three digits after the point.
TEST(StudentT, AgreesWithTables) {
  const std::vector<std::pair<double, double>> table = {{1, 12.706}, {2, 4.303},  {3, 3.182},  {4, 2.776},
                                                        {5, 2.571},  {9, 2.262},  {10, 2.228}, {20, 2.086},
                                                        {30, 2.042}, {60, 2.000}, {120, 1.980}};
  for (const auto& [degrees, quantile] : table) EXPECT_NEAR(student_t_quantile(0.975, degrees), quantile, 5e-4);
  EXPECT_NEAR(student_t_quantile(0.995, 4), 4.604, 5e-4);
  EXPECT_NEAR(student_t_quantile(0.975, 1e7), 1.959964, 1e-5) << "the normal distribution in the limit";
  EXPECT_DOUBLE_EQ(student_t_quantile(0.025, 7), -student_t_quantile(0.975, 7));
}

TEST(Estimate, HasTheIntervalOfAWorkedExample) {
  const Estimate result = estimate(std::vector<double>{1, 2, 3, 4, 5});
  EXPECT_DOUBLE_EQ(result.mean, 3);
  EXPECT_NEAR(result.standard_deviation, std::sqrt(2.5), 1e-12);
  EXPECT_NEAR(result.high - 3, 2.776445105 * std::sqrt(2.5 / 5), 1e-8);
  EXPECT_NEAR(3 - result.low, result.high - 3, 1e-12);
  EXPECT_EQ(result.count, 5U);
}

TEST(Estimate, SaysNothingOfTheSpreadOfOneSample) {
  const Estimate one = estimate(std::vector<double>{7});
  EXPECT_EQ(one.low, 7);
  EXPECT_EQ(one.high, 7);
  EXPECT_EQ(one.count, 1U);
  EXPECT_EQ(estimate({}).count, 0U);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(estimate(std::vector<double>{infinity, infinity}).mean, infinity) << "PSNR of equal images";
}

// 95 of 100 intervals hold the true mean: what "95 % confidence" says.
TEST(Estimate, IntervalsHoldTheTruthAsOftenAsTheySay) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal(2, 0.7);
  int held = 0;
  constexpr int kTrials = 20'000;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> samples(4);
    for (double& sample : samples) sample = normal(random);
    const Estimate result = estimate(samples);
    held += result.low <= 2 && 2 <= result.high ? 1 : 0;
  }
  EXPECT_NEAR(held / double{kTrials}, 0.95, 5 * std::sqrt(0.95 * 0.05 / kTrials));
}

// The seeds differ far more than the settings do; pairs tell the settings apart nevertheless.
TEST(ComparePaired, TakesOutWhatSeedsHaveInCommon) {
  const std::vector<double> baseline = {10, 20, 30, 40};
  const Verdict verdict = compare_paired(std::vector<double>{10.1, 20.12, 30.08, 40.1}, baseline);
  EXPECT_FALSE(verdict.within_noise);
  EXPECT_NEAR(verdict.difference.mean, 0.1, 1e-9);
  EXPECT_NEAR(verdict.ratio, 100.4 / 100, 1e-9);
  const Verdict noise = compare_paired(std::vector<double>{10.1, 19.9, 30.2, 39.8}, baseline);
  EXPECT_TRUE(noise.within_noise);
}

TEST(ComparePaired, OneSeedProvesNothing) {
  EXPECT_TRUE(compare_paired(std::vector<double>{5}, std::vector<double>{1}).within_noise);
  EXPECT_DOUBLE_EQ(compare_paired(std::vector<double>{5}, std::vector<double>{1}).ratio, 5);
}

TEST(ComparePaired, EqualSamplesAreWithinTheNoiseAndConstantDifferencesAreNot) {
  const std::vector<double> samples = {1, 2, 3};
  EXPECT_TRUE(compare_paired(samples, samples).within_noise);
  EXPECT_FALSE(compare_paired(std::vector<double>{2, 3, 4}, samples).within_noise);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(compare_paired(std::vector<double>{infinity}, std::vector<double>{infinity}).within_noise);
}

// Tables of the sign test: 6 values lie around the median with probability 1 - 2 / 64; of 20, the 6th to the 15th.
TEST(PairedRatio, TakesItsIntervalFromOrderStatistics) {
  for (const auto& [count, first] : {std::pair(5, 0), {6, 1}, {8, 1}, {9, 2}, {20, 6}, {100, 40}}) {
    std::vector<double> a;
    for (int i = 1; i <= count; ++i) a.push_back(10 + i);
    const RatioEstimate ratio = paired_ratio(a, std::vector<double>(a.size(), 1));
    EXPECT_EQ(ratio.median, 10 + (count + 1) / 2.0);
    EXPECT_EQ(ratio.low, 10 + std::max(first, 1)) << count;
    EXPECT_EQ(ratio.high, 10 + count + 1 - std::max(first, 1)) << count;
    EXPECT_EQ(ratio.within_noise, first == 0) << count;
  }
  EXPECT_TRUE(paired_ratio({}, {}).within_noise);
}

TEST(PairedRatio, HoldsTheTruthAsOftenAsItSaysAndShrugsOffDisturbedFrames) {
  std::mt19937 random(5);
  std::lognormal_distribution<double> noise(0, 0.1);
  std::bernoulli_distribution disturbed(0.1);
  int held = 0;
  int equal = 0;
  constexpr int kTrials = 2000;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> a;
    std::vector<double> b;
    for (int i = 0; i < 15; ++i) {
      const double load = disturbed(random) ? 4 : 1;  // of the machine, in both alike
      a.push_back(1.2 * load * noise(random));
      b.push_back(load * noise(random));
    }
    const RatioEstimate ratio = paired_ratio(a, b);
    held += ratio.low <= 1.2 && 1.2 <= ratio.high ? 1 : 0;
    equal += paired_ratio(b, b).within_noise ? 1 : 0;
  }
  EXPECT_GT(held, kTrials * 94 / 100);
  EXPECT_LT(held, kTrials);
  EXPECT_EQ(equal, kTrials);
}

TEST(Percentile, InterpolatesBetweenOrderStatistics) {
  EXPECT_EQ(percentile({}, 0.5), 0);
  EXPECT_EQ(percentile({3}, 0.95), 3);
  EXPECT_EQ(percentile({4, 1, 3, 2}, 0.5), 2.5);
  EXPECT_EQ(percentile({5, 1, 3}, 0.5), 3);
  std::vector<double> hundred;
  for (int i = 0; i <= 100; ++i) hundred.push_back(100 - i);
  EXPECT_DOUBLE_EQ(percentile(hundred, 0.95), 95);
  EXPECT_DOUBLE_EQ(timing_of({1, 2, 3, 4, 5}).p95, 4.8) << "NumPy's percentile([1,2,3,4,5], 95)";
}

/// Images as lists of errors against the reference; their products.
std::vector<double> products_of(const std::vector<std::vector<double>>& errors) {
  std::vector<double> products;
  for (const auto& one : errors)
    for (const auto& other : errors) {
      double sum = 0;
      for (size_t i = 0; i < one.size(); ++i) sum += one[i] * other[i];
      products.push_back(sum / static_cast<double>(one.size()));
    }
  return products;
}

// Against the definition, computed from the images by another road.
TEST(SplitError, IsTheErrorOfTheMeanLessTheVarianceOfTheMean) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  constexpr size_t kSeeds = 5;
  constexpr size_t kPixels = 400;
  std::vector<std::vector<double>> errors(kSeeds, std::vector<double>(kPixels));
  for (size_t pixel = 0; pixel < kPixels; ++pixel)
    for (auto& image : errors) image[pixel] = std::sin(0.1 * static_cast<double>(pixel)) + 0.3 * normal(random);
  double bias_squared = 0;
  double variance = 0;
  for (size_t pixel = 0; pixel < kPixels; ++pixel) {
    double mean = 0;
    for (const auto& image : errors) mean += image[pixel] / kSeeds;
    double spread = 0;
    for (const auto& image : errors) spread += (image[pixel] - mean) * (image[pixel] - mean) / (kSeeds - 1);
    bias_squared += (mean * mean - spread / kSeeds) / kPixels;
    variance += spread / kPixels;
  }
  const ErrorSplit split = split_error(products_of(errors), kSeeds);
  EXPECT_NEAR(split.bias_squared.mean, bias_squared, 1e-12);
  EXPECT_NEAR(split.variance.mean, variance, 1e-12);
  EXPECT_LT(split.variance.low, variance);
  EXPECT_GT(split.variance.high, variance);
}

// No bias but for noise: zero on average over many studies, below zero in about half of them.
TEST(SplitError, HasNoBiasOfItsOwn) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  double mean_bias = 0;
  double mean_variance = 0;
  int negative = 0;
  constexpr int kStudies = 2000;
  for (int study = 0; study < kStudies; ++study) {
    std::vector<std::vector<double>> errors(3, std::vector<double>(30));
    for (auto& image : errors)
      for (double& error : image) error = 2 * normal(random);
    const ErrorSplit split = split_error(products_of(errors), errors.size());
    mean_bias += split.bias_squared.mean / kStudies;
    mean_variance += split.variance.mean / kStudies;
    negative += split.bias_squared.mean < 0 ? 1 : 0;
  }
  EXPECT_NEAR(mean_bias, 0, 0.03);
  EXPECT_NEAR(mean_variance, 4, 0.06);
  EXPECT_GT(negative, kStudies / 3);
}

TEST(SplitError, NeedsTwoSeedsAndThreeForAnInterval) {
  EXPECT_EQ(split_error(std::vector<double>{4}, 1).bias_squared.count, 0U);
  const ErrorSplit two = split_error(products_of({{1, 3}, {3, 1}}), 2);
  EXPECT_DOUBLE_EQ(two.bias_squared.mean, 3) << "mean 2, variance 2: 4 - 2/2";
  EXPECT_DOUBLE_EQ(two.variance.mean, 2);
  EXPECT_EQ(two.variance.low, two.variance.high);
}

TEST(ParetoFront, HoldsWhatNothingBeats) {
  const std::vector<Point> points = {{1, 9}, {2, 5}, {3, 6}, {4, 1}, {4, 1}, {5, 1}, {0.5, std::nan("")}};
  EXPECT_EQ(pareto_front(points), (std::vector<bool>{true, true, false, true, true, false, false}));
}

TEST(TimeEstimate, WeightsBySetting) {
  TimeEstimate estimate;
  EXPECT_FALSE(estimate.left({0, 1}, 1).has_value());
  EXPECT_EQ(estimate.left({}, 1), 0.0);
  estimate.add(0, 1);
  estimate.add(0, 3);
  estimate.add(1, 10);
  EXPECT_EQ(estimate.of(0), 2.0);
  EXPECT_EQ(estimate.of(7), 6.0) << "of an unknown kind: the mean of the kinds, each once";
  EXPECT_EQ(estimate.left({0, 0, 1}, 1), 14.0);
  EXPECT_EQ(estimate.left({0, 0, 1}, 2), 10.0) << "not sooner than the longest";
}

}  // namespace
}  // namespace lightloom::study
