#include "tests/passes/estimator_support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace lightloom::test {
namespace {

constexpr uint32_t kBlock = 8;

struct Sum {
  double sum = 0, count = 0;
};

Sum block_sum(const image::HostImage& image, uint32_t channel, uint32_t x0, uint32_t y0) {
  Sum result;
  for (uint32_t y = y0; y < std::min(y0 + kBlock, image.desc.extent.height); ++y)
    for (uint32_t x = x0; x < std::min(x0 + kBlock, image.desc.extent.width); ++x) {
      if (image.at(x, y, 0, 3) <= 0) continue;
      result.sum += image.at(x, y, 0, channel);
      ++result.count;
    }
  return result;
}

double deviation(const Estimate& a, const Estimate& b) {
  const double error = std::hypot(a.error, b.error);
  return error > 0 ? (a.mean - b.mean) / error : a.mean == b.mean ? 0 : INFINITY;
}

}  // namespace

Estimate estimate(const std::vector<double>& samples) {
  const auto count = static_cast<double>(samples.size());
  Estimate result;
  for (const double sample : samples) result.mean += sample / count;
  double squares = 0;
  for (const double sample : samples) squares += (sample - result.mean) * (sample - result.mean);
  result.error = std::sqrt(squares / (count - 1) / count);
  return result;
}

ImageEstimate image_estimate(const std::vector<Images>& frames, const std::string& output, uint32_t channel) {
  const Extent3 size = frames.front().at(output).desc.extent;
  ImageEstimate result;
  std::vector<Sum> totals(frames.size());
  for (uint32_t y = 0; y < size.height; y += kBlock)
    for (uint32_t x = 0; x < size.width; x += kBlock) {
      std::vector<double> samples;
      for (size_t f = 0; f < frames.size(); ++f) {
        const Sum block = block_sum(frames[f].at(output), channel, x, y);
        totals[f].sum += block.sum;
        totals[f].count += block.count;
        if (block.count > 0) samples.push_back(block.sum / block.count);
      }
      if (!samples.empty()) result.blocks.push_back(estimate(samples));
    }
  std::vector<double> means;
  for (const Sum& total : totals) means.push_back(total.sum / total.count);
  result.whole = estimate(means);
  return result;
}

void expect_agreement(const ImageEstimate& a, const ImageEstimate& b, const std::string& what) {
  EXPECT_LT(std::abs(deviation(a.whole, b.whole)), 3)
      << what << ": " << a.whole.mean << " +- " << a.whole.error << ", " << b.whole.mean << " +- " << b.whole.error;
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  double sum = 0;
  int outliers = 0;
  for (size_t k = 0; k < a.blocks.size(); ++k) {
    const double z = std::abs(deviation(a.blocks[k], b.blocks[k]));
    sum += z;
    outliers += z > 3.3 ? 1 : 0;
  }
  const auto count = static_cast<double>(a.blocks.size());
  // |z| of a normal distribution: mean 0.798, standard deviation 0.603.
  EXPECT_LT(sum / count, 0.8 + 3 * 0.61 / std::sqrt(count)) << what;
  EXPECT_LE(outliers, 1 + static_cast<int>(0.005 * count)) << what;
}

}  // namespace lightloom::test
