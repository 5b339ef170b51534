#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lightloom::image {

/// A filter along one axis that is symmetric or antisymmetric about its middle. Those that take differences do so
/// before they weigh, so that a constant gives exactly 0.
struct Kernel {
  enum class Form : uint8_t {
    mean,       ///< middle p(0) + sum of side[k - 1] (p(k) + p(-k))
    slope,      ///< sum of side[k - 1] (p(k) - p(-k))
    curvature,  ///< sum of side[k - 1] ((p(k) - p(0)) + (p(-k) - p(0)))
  };
  Form form = Form::mean;
  float middle = 1;
  std::vector<float> side;

  [[nodiscard]] size_t radius() const { return side.size(); }
};

/// Rows of an image as a filter along y sees them: row `y` + offset, the first and last repeated beyond the edges.
class ColumnNeighbours {
 public:
  ColumnNeighbours(const std::vector<float>& plane, size_t width, size_t height, size_t y)
      : plane_(plane.data()), width_(width), last_(static_cast<std::ptrdiff_t>(height) - 1), y_(y) {}
  [[nodiscard]] const float* at(std::ptrdiff_t offset) const;

 private:
  const float* plane_;
  size_t width_;
  std::ptrdiff_t last_;
  size_t y_;
};

/// One row as a filter along x sees it: shifted by an offset up to `radius`, the ends repeated.
class RowNeighbours {
 public:
  /// Copies the row into `padded`, which must outlive this.
  RowNeighbours(std::span<const float> row, size_t radius, std::vector<float>& padded);
  [[nodiscard]] const float* at(std::ptrdiff_t offset) const { return middle_ + offset; }

 private:
  const float* middle_;
};

/// Filters a row: out[0..width).
void filter(const Kernel& kernel, const ColumnNeighbours& neighbours, std::span<float> out);
void filter(const Kernel& kernel, const RowNeighbours& neighbours, std::span<float> out);

}  // namespace lightloom::image
