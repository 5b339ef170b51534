#include "framework/image/flip.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/parallel.hpp"
#include "framework/image/flip_rows.hpp"

namespace lightloom::image::flip {
namespace {

/// Narkowicz's fit of the ACES tone curve, without its pre-exposure of 0.6:
/// (a x^2 + b x) / (c x^2 + d x + e).
struct ToneCurve {
  static constexpr double kPreExposure = 0.6;
  static constexpr double kA = kPreExposure * kPreExposure * 2.51, kB = kPreExposure * 0.03;
  static constexpr double kC = kPreExposure * kPreExposure * 2.43, kD = kPreExposure * 0.59, kE = 0.14;

  static float at(float x) {
    return x * (static_cast<float>(kA) * x + static_cast<float>(kB)) /
           (x * (static_cast<float>(kC) * x + static_cast<float>(kD)) + static_cast<float>(kE));
  }
  /// The positive x at which the curve has the value y < a / c.
  static double inverse(double y) {
    const double a = kA - y * kC, b = kB - y * kD, c = -y * kE;
    return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
  }
};

constexpr double kToneMappedLevel = 0.85;
constexpr float kWhiteOut = 1e6f;  // far above what the curve maps to 1, its square far below the largest float

struct Exposed {
  const Planes& planes;
  bool tone_mapped;
  float factor;

  [[nodiscard]] float channel(size_t c, size_t pixel) const {
    const float value = std::max(0.0f, planes.channels[c][pixel]);
    return std::min(1.0f, tone_mapped ? ToneCurve::at(std::min(kWhiteOut, value * factor)) : value);
  }
};

void to_ycxcz(const Exposed& from, Planes& to, unsigned threads) {
  parallel_runs(to.pixel_count(), threads, [&](size_t begin, size_t end) {
    for (size_t pixel = begin; pixel < end; ++pixel) {
      const Triple ycxcz = ycxcz_from_linear({from.channel(0, pixel), from.channel(1, pixel), from.channel(2, pixel)});
      to.channels[0][pixel] = ycxcz.x;
      to.channels[1][pixel] = ycxcz.y;
      to.channels[2][pixel] = ycxcz.z;
    }
  });
}

/// FLIP of display values, and the larger of this and what `map` holds.
class MapBuilder {
 public:
  MapBuilder(const ComparedImages& images, const MetricOptions& options)
      : images_(images),
        filters_(make_filters(options.pixels_per_degree)),
        threads_(options.threads),
        reference_(empty_planes()),
        test_(empty_planes()),
        map_(reference_.pixel_count()) {}

  void add(bool tone_mapped, double exposure) {
    const auto factor = static_cast<float>(std::exp2(exposure));
    to_ycxcz({images_.reference, tone_mapped, factor}, reference_, threads_);
    to_ycxcz({images_.test, tone_mapped, factor}, test_, threads_);
    const size_t width = reference_.width;
    parallel_runs(reference_.height, threads_, [&](size_t begin, size_t end) {
      RowEvaluator evaluator(filters_, width, reference_.height);
      std::vector<float> row(width);
      for (size_t y = begin; y < end; ++y) {
        evaluator.evaluate(reference_, test_, y, row.data());
        for (size_t x = 0; x < width; ++x) map_[y * width + x] = std::max(map_[y * width + x], row[x]);
      }
    });
  }

  [[nodiscard]] std::vector<float> take() {
    for (size_t pixel = 0; pixel < map_.size(); ++pixel)
      if (images_.usable[pixel] == 0) map_[pixel] = 0;
    return std::move(map_);
  }

 private:
  [[nodiscard]] Planes empty_planes() const {
    Planes planes{images_.reference.width, images_.reference.height, {}};
    for (std::vector<float>& channel : planes.channels) channel.resize(planes.pixel_count());
    return planes;
  }

  const ComparedImages& images_;
  Filters filters_;
  unsigned threads_;
  Planes reference_;  ///< in YCxCz, at the present exposure
  Planes test_;
  std::vector<float> map_;
};

/// As the published program has it: the mean of the two values in the middle, also where their number is odd (then the
/// middle one and the one below).
double median_of(std::vector<double> values) {
  if (values.empty()) return 0;
  if (values.size() == 1) return values.front();
  const auto upper = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), upper, values.end());
  return (*std::max_element(values.begin(), upper) + *upper) / 2;
}

}  // namespace

std::vector<double> exposures(const ComparedImages& images) {
  std::vector<double> luminances;
  luminances.reserve(images.reference.pixel_count());
  for (size_t pixel = 0; pixel < images.reference.pixel_count(); ++pixel) {
    if (images.reference_usable[pixel] == 0) continue;
    double value = 0;
    for (size_t c = 0; c < 3; ++c)
      value += kLuminanceWeights[c] * std::max(0.0, static_cast<double>(images.reference.channels[c][pixel]));
    luminances.push_back(value);
  }
  double median = median_of(luminances);
  if (!(median > 0)) {
    std::erase_if(luminances, [](double value) { return !(value > 0); });
    median = median_of(luminances);
  }
  if (luminances.empty()) return {};
  const double level = ToneCurve::inverse(kToneMappedLevel);
  const double start = std::log2(level / *std::max_element(luminances.begin(), luminances.end()));
  const double stop = std::log2(level / median);
  const auto count = static_cast<size_t>(std::max(2.0, std::ceil(stop - start)));
  std::vector<double> result;
  for (size_t k = 0; k < count; ++k)
    result.push_back(start + (stop - start) * static_cast<double>(k) / static_cast<double>(count - 1));
  return result;
}

std::vector<float> error_map(const ComparedImages& images, const MetricOptions& options) {
  MapBuilder builder(images, options);
  const std::vector<double> levels = options.flip == FlipKind::hdr ? exposures(images) : std::vector<double>();
  if (levels.empty()) builder.add(false, 0);
  for (size_t k = 0; k < levels.size(); ++k)
    if (k == 0 || levels[k] > levels[k - 1]) builder.add(true, levels[k]);
  return builder.take();
}

}  // namespace lightloom::image::flip
