#include "framework/image/flip_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/image/row_filter.hpp"

namespace lightloom::image::flip {
namespace {

constexpr float kColorExponent = 0.7f;     // q_c
constexpr float kKnee = 0.4f;              // p_c: share of the largest difference that is mapped to ...
constexpr float kKneeError = 0.95f;        // p_t: ... this error
constexpr float kLuminanceRange = 116.0f;  // of Y, whose offset derivatives do not see

/// Of green and blue, the two colours of sRGB that are farthest apart.
float largest_color_difference() {
  const auto lab = [](const Triple& rgb) { return hunt_adjusted(lab_from_xyz(transform<kToRelativeXyz>(rgb))); };
  return std::pow(hyab(lab({0, 1, 0}), lab({0, 0, 1})), kColorExponent);
}

Triple perceived(const Triple& ycxcz) {
  const Triple rgb = clamped(transform<kFromRelativeXyz>(xyz_from_ycxcz(ycxcz)));
  return hunt_adjusted(lab_from_xyz(transform<kToRelativeXyz>(rgb)));
}

float color_difference(const Triple& reference, const Triple& test) {
  static const float largest = largest_color_difference();
  const float knee = kKnee * largest;
  const float difference = std::pow(hyab(perceived(reference), perceived(test)), kColorExponent);
  if (difference < knee) return difference * (kKneeError / knee);
  return std::min(1.0f, kKneeError + (difference - knee) / (largest - knee) * (1 - kKneeError));
}

}  // namespace

float pixel_error(const Triple& reference, const Triple& test, float feature_difference) {
  // The exponent of the difference of features, q_f, is 1/2.
  const float features = std::sqrt(std::min(1.0f, feature_difference / std::numbers::sqrt2_v<float>));
  const float color = color_difference(reference, test);
  return color > 0 ? std::pow(color, 1 - features) : 0;
}

RowEvaluator::RowEvaluator(const Filters& filters, size_t width, size_t height)
    : filters_(filters), width_(width), height_(height), column_(width), part_(width) {
  for (FilteredRow* row : {&reference_, &test_})
    for (Row* values : {&row->y, &row->cx, &row->cz, &row->edge, &row->point}) values->resize(width);
}

void RowEvaluator::filter_both(const std::vector<float>& plane, size_t y, const Kernel& along_x, const Kernel& along_y,
                               Row& row) {
  filter(along_y, ColumnNeighbours(plane, width_, height_, y), column_);
  filter(along_x, RowNeighbours(column_, along_x.radius(), padded_), row);
}

void RowEvaluator::magnitude(const std::vector<float>& plane, size_t y, const Kernel& derivative, Row& row) {
  filter_both(plane, y, derivative, filters_.gaussian, row);
  filter_both(plane, y, filters_.gaussian, derivative, part_);
  for (size_t x = 0; x < width_; ++x) row[x] = std::sqrt(row[x] * row[x] + part_[x] * part_[x]) / kLuminanceRange;
}

void RowEvaluator::see(const Planes& image, size_t y, FilteredRow& row) {
  const auto& [luminance, red_green, blue_yellow] = image.channels;
  filter_both(luminance, y, filters_.achromatic, filters_.achromatic, row.y);
  filter_both(red_green, y, filters_.red_green, filters_.red_green, row.cx);
  filter_both(blue_yellow, y, filters_.blue_yellow_wide, filters_.blue_yellow_wide, row.cz);
  filter_both(blue_yellow, y, filters_.blue_yellow_narrow, filters_.blue_yellow_narrow, part_);
  for (size_t x = 0; x < width_; ++x) row.cz[x] += part_[x];
  magnitude(luminance, y, filters_.edge, row.edge);
  magnitude(luminance, y, filters_.point, row.point);
}

void RowEvaluator::evaluate(const Planes& reference, const Planes& test, size_t y, float* out) {
  see(reference, y, reference_);
  see(test, y, test_);
  for (size_t x = 0; x < width_; ++x) {
    const float edge = std::abs(reference_.edge[x] - test_.edge[x]);
    const float point = std::abs(reference_.point[x] - test_.point[x]);
    out[x] = pixel_error({reference_.y[x], reference_.cx[x], reference_.cz[x]}, {test_.y[x], test_.cx[x], test_.cz[x]},
                         std::max(edge, point));
  }
}

}  // namespace lightloom::image::flip
