#pragma once

#include <array>
#include <vector>

#include "framework/image/compared_images.hpp"
#include "framework/image/flip_color.hpp"
#include "framework/image/flip_filters.hpp"

namespace lightloom::image::flip {

/// FLIP of display values (HPG 2020), row by row. Not for use by several threads at once: it holds what a row needs.
class RowEvaluator {
 public:
  RowEvaluator(const Filters& filters, size_t width, size_t height);

  /// FLIP of each pixel of row `y`, 0..1, to out[0..width). Both images in YCxCz of colours from 0 to 1.
  void evaluate(const Planes& reference, const Planes& test, size_t y, float* out);

 private:
  using Row = std::vector<float>;
  struct FilteredRow {
    Row y, cx, cz;    ///< as the eye sees them
    Row edge, point;  ///< magnitudes of the features' gradients of Y, which goes from 0 to 1 here
  };
  void see(const Planes& image, size_t y, FilteredRow& row);
  /// A product of two filters, one along each axis.
  void filter_both(const std::vector<float>& plane, size_t y, const Kernel& along_x, const Kernel& along_y, Row& row);
  /// Length of the vector of `derivative` along x and along y.
  void magnitude(const std::vector<float>& plane, size_t y, const Kernel& derivative, Row& row);

  const Filters& filters_;
  size_t width_;
  size_t height_;
  FilteredRow reference_;
  FilteredRow test_;
  Row column_;  ///< a row filtered along y
  Row part_;
  Row padded_;
};

/// FLIP's error of a pixel from its colours as the eye sees them (YCxCz) and the difference of its features, 0..1.
[[nodiscard]] float pixel_error(const Triple& reference, const Triple& test, float feature_difference);

}  // namespace lightloom::image::flip
