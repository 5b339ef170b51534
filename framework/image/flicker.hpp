#pragma once

#include <cstddef>
#include <vector>

#include "framework/image/host_image.hpp"

namespace lightloom::image {

/// How much a sequence of frames changes, by the luminances of its pixels. Pixels that are not finite in some frame are
/// left out of both figures.
struct Flicker {
  /// Mean over pixels of the standard deviation over frames (divisor: frames - 1). For a still view: the noise that is
  /// seen as flicker.
  double deviation = 0;
  /// Mean over pixels and pairs of consecutive frames of |F_t - F_(t-1)|. Where something moves, compare it with the
  /// reference's.
  double step = 0;
};

/// Takes frames one after another, so that no more than one is held.
class FlickerMeter {
 public:
  /// Throws Error(invalid_input) where the frame cannot be compared or differs in size from the first.
  void add(const HostImage& frame);
  /// NaN for fewer than two frames, or without a finite pixel.
  [[nodiscard]] Flicker result() const;
  [[nodiscard]] size_t frame_count() const { return count_; }

 private:
  struct Pixel {
    double mean = 0;     ///< Welford's running mean ...
    double squares = 0;  ///< ... and sum of squared differences from it
    double steps = 0;
    double last = 0;
  };
  size_t count_ = 0;
  Extent3 extent_;
  std::vector<Pixel> pixels_;
};

}  // namespace lightloom::image
