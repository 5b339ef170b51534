#pragma once

#include <cstdint>
#include <vector>

#include "framework/image/host_image.hpp"

namespace lightloom::study {

/// Running mean of images of one size, by pixel and colour, in double precision (Welford's algorithm).
class MeanImage {
 public:
  void add(const image::HostImage& image);
  [[nodiscard]] uint32_t count() const { return count_; }
  [[nodiscard]] image::HostImage mean() const;  ///< rgba32_sfloat, alpha 1
  /// Mean over pixels and colours of (standard error)^2 / (mean^2 + epsilon): what relMSE says of a perfect image
  /// because of this one's noise. Only for independent images; 0 for fewer than two.
  [[nodiscard]] double relative_noise(double epsilon) const;

 private:
  uint32_t width_ = 0, height_ = 0, count_ = 0;
  std::vector<double> means_;    ///< 3 a pixel
  std::vector<double> squares_;  ///< sum of squared deviations
};

/// The same figure, given the standard error of each pixel (1 channel, or a colour).
[[nodiscard]] double relative_noise(const image::HostImage& radiance, const image::HostImage& standard_error,
                                    double epsilon);

}  // namespace lightloom::study
