#include "framework/image/row_filter.hpp"

#include <algorithm>

namespace lightloom::image {
namespace {

template <typename Neighbours, typename Combine>
void add_sides(const Kernel& kernel, const Neighbours& neighbours, std::span<float> out, const Combine& combine) {
  const float* middle = neighbours.at(0);
  const size_t count = out.size();
  float* sum = out.data();
  for (size_t k = 0; k < kernel.side.size(); ++k) {
    const auto offset = static_cast<std::ptrdiff_t>(k + 1);
    const float* after = neighbours.at(offset);
    const float* before = neighbours.at(-offset);
    const float weight = kernel.side[k];
    for (size_t x = 0; x < count; ++x) sum[x] += weight * combine(after[x], before[x], middle[x]);
  }
}

template <typename Neighbours>
void filter_row(const Kernel& kernel, const Neighbours& neighbours, std::span<float> out) {
  const float* middle = neighbours.at(0);
  switch (kernel.form) {
    case Kernel::Form::mean:
      for (size_t x = 0; x < out.size(); ++x) out[x] = kernel.middle * middle[x];
      return add_sides(kernel, neighbours, out, [](float after, float before, float) { return after + before; });
    case Kernel::Form::slope:
      std::fill(out.begin(), out.end(), 0.0f);
      return add_sides(kernel, neighbours, out, [](float after, float before, float) { return after - before; });
    case Kernel::Form::curvature:
      std::fill(out.begin(), out.end(), 0.0f);
      return add_sides(kernel, neighbours, out,
                       [](float after, float before, float here) { return (after - here) + (before - here); });
  }
}

}  // namespace

const float* ColumnNeighbours::at(std::ptrdiff_t offset) const {
  const std::ptrdiff_t row = std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(y_) + offset, 0, last_);
  return plane_ + static_cast<size_t>(row) * width_;
}

RowNeighbours::RowNeighbours(std::span<const float> row, size_t radius, std::vector<float>& padded) {
  padded.resize(row.size() + 2 * radius);
  std::fill_n(padded.begin(), radius, row.front());
  std::copy(row.begin(), row.end(), padded.begin() + static_cast<std::ptrdiff_t>(radius));
  std::fill_n(padded.end() - static_cast<std::ptrdiff_t>(radius), radius, row.back());
  middle_ = padded.data() + radius;
}

void filter(const Kernel& kernel, const ColumnNeighbours& neighbours, std::span<float> out) {
  filter_row(kernel, neighbours, out);
}

void filter(const Kernel& kernel, const RowNeighbours& neighbours, std::span<float> out) {
  filter_row(kernel, neighbours, out);
}

}  // namespace lightloom::image
