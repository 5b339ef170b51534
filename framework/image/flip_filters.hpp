#pragma once

#include "framework/image/row_filter.hpp"

namespace lightloom::image::flip {

/// FLIP's filters along one axis; the two-dimensional ones are products of them.
struct Filters {
  /// Contrast sensitivity of the eye, sums 1 (HPG 2020, section 4.1): of Y and of Cx; that of Cz is the sum of two
  /// Gaussians, each the square of one of these: the two-dimensional sums add up to 1.
  Kernel achromatic;
  Kernel red_green;
  Kernel blue_yellow_wide;
  Kernel blue_yellow_narrow;
  /// Feature detection (section 4.2): a Gaussian of sum 1, and its first and second derivative, whose positive weights
  /// sum to 1 and whose negative ones to -1.
  Kernel gaussian;
  Kernel edge;
  Kernel point;
};

/// Pixels per degree of the visual field, at least 1.
[[nodiscard]] Filters make_filters(double pixels_per_degree);

}  // namespace lightloom::image::flip
