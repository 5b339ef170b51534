#include "framework/study/mean_image.hpp"

#include <algorithm>
#include <cstring>

#include "framework/graph/format.hpp"

namespace lightloom::study {

void MeanImage::add(const image::HostImage& image) {
  if (count_ == 0) {
    width_ = image.desc.extent.width;
    height_ = image.desc.extent.height;
    means_.assign(size_t{3} * width_ * height_, 0);
    squares_ = means_;
  }
  ++count_;
  size_t i = 0;
  for (uint32_t y = 0; y < height_; ++y)
    for (uint32_t x = 0; x < width_; ++x)
      for (uint32_t c = 0; c < 3; ++c, ++i) {
        const double value = image.at(x, y, 0, c);
        const double before = value - means_[i];
        means_[i] += before / count_;
        squares_[i] += before * (value - means_[i]);
      }
}

image::HostImage MeanImage::mean() const {
  image::HostImage image{{Format::rgba32_sfloat, Dimension::d2, {width_, height_, 1}}, {}};
  std::vector<float> samples;
  samples.reserve(means_.size() / 3 * 4);
  for (size_t i = 0; i < means_.size(); ++i) {
    samples.push_back(static_cast<float>(means_[i]));
    if (i % 3 == 2) samples.push_back(1);
  }
  image.texels.resize(samples.size() * sizeof(float));
  if (!samples.empty()) std::memcpy(image.texels.data(), samples.data(), image.texels.size());
  return image;
}

double MeanImage::relative_noise(double epsilon) const {
  if (count_ < 2) return 0;
  const double samples = count_;
  double sum = 0;
  for (size_t i = 0; i < means_.size(); ++i)
    sum += squares_[i] / ((samples - 1) * samples) / (means_[i] * means_[i] + epsilon);
  return sum / static_cast<double>(means_.size());
}

double relative_noise(const image::HostImage& radiance, const image::HostImage& standard_error, double epsilon) {
  const Extent3 extent = radiance.desc.extent;
  const uint32_t channels = format_info(standard_error.desc.format).channels;
  double sum = 0;
  for (uint32_t y = 0; y < extent.height; ++y)
    for (uint32_t x = 0; x < extent.width; ++x)
      for (uint32_t c = 0; c < 3; ++c) {
        const double value = radiance.at(x, y, 0, c);
        const double error = standard_error.at(x, y, 0, std::min(c, channels - 1));
        sum += error * error / (value * value + epsilon);
      }
  return sum / (3.0 * extent.width * extent.height);
}

}  // namespace lightloom::study
