#include "framework/image/ssim.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "framework/base/parallel.hpp"

namespace lightloom::image {
namespace {

constexpr size_t kWindow = 11;  // [pixels]
constexpr double kSigma = 1.5;  // [pixels]
constexpr double kC1 = 0.0001;  // (K1 * range)^2
constexpr double kC2 = 0.0009;  // (K2 * range)^2
constexpr size_t kMoments = 5;  // E[r], E[t], E[r^2], E[t^2], E[r t]

using Rows = std::array<std::vector<double>, kMoments>;

std::vector<double> gaussian_window(size_t side) {
  std::vector<double> taps(std::min(kWindow, side));
  const double middle = (static_cast<double>(taps.size()) - 1) / 2;
  double sum = 0;
  for (size_t k = 0; k < taps.size(); ++k) {
    const double offset = static_cast<double>(k) - middle;
    taps[k] = std::exp(-offset * offset / (2 * kSigma * kSigma));
    sum += taps[k];
  }
  for (double& tap : taps) tap /= sum;
  return taps;
}

/// out[x] = sum over k of taps[k] * row[x + k].
void slide(const std::vector<double>& taps, const std::vector<double>& row, std::vector<double>& out) {
  for (size_t k = 0; k < taps.size(); ++k) {
    const double weight = taps[k];
    const double* from = row.data() + k;
    for (size_t x = 0; x < out.size(); ++x) out[x] += weight * from[x];
  }
}

std::vector<double> luminances(const Planes& planes) {
  std::vector<double> values(planes.pixel_count());
  for (size_t pixel = 0; pixel < values.size(); ++pixel) values[pixel] = luminance(planes, pixel);
  return values;
}

double similarity(double mean_r, double mean_t, double square_r, double square_t, double product) {
  const double variance_r = square_r - mean_r * mean_r;
  const double variance_t = square_t - mean_t * mean_t;
  const double covariance = product - mean_r * mean_t;
  const double means = (2 * (mean_r * mean_t) + kC1) / (mean_r * mean_r + mean_t * mean_t + kC1);
  return means * ((2 * covariance + kC2) / (variance_r + variance_t + kC2));
}

class Windows {
 public:
  explicit Windows(const ComparedImages& images)
      : images_(images),
        width_(images.reference.width),
        reference_(luminances(images.reference)),
        test_(luminances(images.test)),
        across_(gaussian_window(images.reference.width)),
        down_(gaussian_window(images.reference.height)) {}

  [[nodiscard]] size_t rows() const { return images_.reference.height - down_.size() + 1; }

  /// Sum of the similarity of all windows whose upper edge is row `top`, and how many they are.
  [[nodiscard]] std::pair<double, size_t> row_sum(size_t top) const {
    const Rows down = weigh_columns(top);
    const size_t count = width_ - across_.size() + 1;
    Rows moments;
    for (size_t m = 0; m < kMoments; ++m) {
      moments[m].assign(count, 0);
      slide(across_, down[m], moments[m]);
    }
    double sum = 0;
    size_t usable = 0;
    const uint8_t* middle = images_.usable.data() + (top + down_.size() / 2) * width_ + across_.size() / 2;
    for (size_t x = 0; x < count; ++x) {
      if (middle[x] == 0) continue;
      sum += similarity(moments[0][x], moments[1][x], moments[2][x], moments[3][x], moments[4][x]);
      ++usable;
    }
    return {sum, usable};
  }

 private:
  [[nodiscard]] Rows weigh_columns(size_t top) const {
    Rows rows;
    for (std::vector<double>& row : rows) row.assign(width_, 0);
    for (size_t k = 0; k < down_.size(); ++k) {
      const double* r = reference_.data() + (top + k) * width_;
      const double* t = test_.data() + (top + k) * width_;
      const double weight = down_[k];
      for (size_t x = 0; x < width_; ++x) {
        rows[0][x] += weight * r[x];
        rows[1][x] += weight * t[x];
        rows[2][x] += weight * (r[x] * r[x]);
        rows[3][x] += weight * (t[x] * t[x]);
        rows[4][x] += weight * (r[x] * t[x]);
      }
    }
    return rows;
  }

  const ComparedImages& images_;
  size_t width_;
  std::vector<double> reference_;
  std::vector<double> test_;
  std::vector<double> across_;
  std::vector<double> down_;
};

}  // namespace

double mean_ssim(const ComparedImages& images, unsigned threads) {
  const Windows windows(images);
  std::vector<std::pair<double, size_t>> rows(windows.rows());
  parallel_runs(rows.size(), threads, [&](size_t begin, size_t end) {
    for (size_t row = begin; row < end; ++row) rows[row] = windows.row_sum(row);
  });
  double sum = 0;
  size_t count = 0;
  for (const auto& [of_row, usable] : rows) {
    sum += of_row;
    count += usable;
  }
  return count > 0 ? sum / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace lightloom::image
