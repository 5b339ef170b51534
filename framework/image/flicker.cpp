#include "framework/image/flicker.hpp"

#include <cmath>
#include <limits>

#include "framework/base/error.hpp"
#include "framework/image/compared_images.hpp"

namespace lightloom::image {

void FlickerMeter::add(const HostImage& frame) {
  const Planes planes = planes_of(frame, "frame");
  if (count_ == 0) {
    extent_ = frame.desc.extent;
    pixels_.resize(planes.pixel_count());
  } else if (frame.desc.extent != extent_) {
    throw Error(ExitCode::invalid_input, "the frames of a sequence differ in size: the first has " +
                                             to_string(extent_) + " pixels, a later one " +
                                             to_string(frame.desc.extent));
  }
  ++count_;
  for (size_t k = 0; k < pixels_.size(); ++k) {
    Pixel& pixel = pixels_[k];
    const double value = luminance(planes, k);
    const double from_old_mean = value - pixel.mean;
    pixel.mean += from_old_mean / static_cast<double>(count_);
    pixel.squares += from_old_mean * (value - pixel.mean);
    if (count_ > 1) pixel.steps += std::abs(value - pixel.last);
    pixel.last = value;
  }
}

Flicker FlickerMeter::result() const {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  Flicker sum;
  size_t finite = 0;
  for (const Pixel& pixel : pixels_) {
    if (!std::isfinite(pixel.squares) || !std::isfinite(pixel.steps)) continue;  // what is not finite stays so
    sum.deviation += std::sqrt(pixel.squares / (static_cast<double>(count_) - 1));
    sum.step += pixel.steps / (static_cast<double>(count_) - 1);
    ++finite;
  }
  if (count_ < 2 || finite == 0) return {kNan, kNan};
  return {sum.deviation / static_cast<double>(finite), sum.step / static_cast<double>(finite)};
}

}  // namespace lightloom::image
