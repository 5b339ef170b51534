#include "framework/study/judge.hpp"

#include <cmath>

#include "framework/image/metrics.hpp"

namespace lightloom::study {
namespace {

MetricValues values_of(const image::Metrics& metrics) {
  return {{"mse", metrics.mse},
          {"rmse", metrics.rmse},
          {"psnr", metrics.psnr},
          {"relmse", metrics.relmse},
          {"mape", metrics.mape},
          {"smape", metrics.smape},
          {"ssim", metrics.ssim},
          {"flip", metrics.flip},
          {"mean_error", metrics.mean_error},
          {"max_error", metrics.max_error},
          {"bias", metrics.bias},
          {"fireflies", static_cast<double>(metrics.fireflies)},
          {"non_finite", static_cast<double>(metrics.non_finite)}};
}

}  // namespace

Judgement judge(const std::vector<image::HostImage>& references, const std::vector<image::HostImage>& tests,
                unsigned threads) {
  image::MetricOptions options;
  options.threads = threads;
  Judgement judgement;
  for (size_t i = 0; i < tests.size(); ++i) {
    const image::MetricsAndMap compared = image::compare_with_flip_map(references.at(i), tests[i], options);
    for (const auto& [name, value] : values_of(compared.metrics))
      judgement.metrics[name] += value / static_cast<double>(tests.size());
    if (i + 1 == tests.size()) judgement.heat_map = image::heat_map(compared.flip_map, 1);
  }
  return judgement;
}

std::vector<double> error_products(const image::HostImage& reference, const std::vector<image::HostImage>& tests) {
  const size_t seeds = tests.size();
  std::vector<double> products(seeds * seeds, 0);
  std::vector<double> errors(3 * seeds);
  const Extent3 extent = reference.desc.extent;
  double count = 0;
  for (uint32_t y = 0; y < extent.height; ++y)
    for (uint32_t x = 0; x < extent.width; ++x) {
      bool finite = true;
      for (size_t i = 0; i < seeds; ++i)
        for (uint32_t c = 0; c < 3; ++c) {
          errors[3 * i + c] = tests[i].at(x, y, 0, c) - reference.at(x, y, 0, c);
          finite = finite && std::isfinite(errors[3 * i + c]);
        }
      if (!finite) continue;
      count += 3;
      for (size_t i = 0; i < seeds; ++i)
        for (size_t j = i; j < seeds; ++j)
          for (size_t c = 0; c < 3; ++c) products[i * seeds + j] += errors[3 * i + c] * errors[3 * j + c];
    }
  for (size_t i = 0; i < seeds; ++i)
    for (size_t j = i; j < seeds; ++j)
      products[j * seeds + i] = products[i * seeds + j] = count > 0 ? products[i * seeds + j] / count : 0;
  return products;
}

}  // namespace lightloom::study
