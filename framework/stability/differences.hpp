#pragma once

#include "framework/image/host_image.hpp"

namespace lightloom::stability {

/// Texels whose bits differ; all of them where the sizes or formats do.
[[nodiscard]] double differing_texels(const image::HostImage& a, const image::HostImage& b);

/// Texels with a NaN or an infinity in any channel.
[[nodiscard]] double non_finite_texels(const image::HostImage& image);

/// Largest |test - reference| over the first three channels, relative to the larger of the reference there and the mean
/// of the reference's magnitude. Images of one size.
[[nodiscard]] double largest_relative_difference(const image::HostImage& reference, const image::HostImage& test);

/// Share of the texels for which that is above `bound`.
[[nodiscard]] double share_beyond(const image::HostImage& reference, const image::HostImage& test, double bound);

/// 10 log10(peak^2 / mean squared difference) over the first three channels [dB]; the peak is the largest value of the
/// reference. 999 for equal images.
[[nodiscard]] double peak_signal_to_noise(const image::HostImage& reference, const image::HostImage& test);

/// Mean of the first three channels, and its standard error if texels are independent.
struct Mean {
  double value = 0;
  double error = 0;
};
[[nodiscard]] Mean mean_of(const image::HostImage& image);

/// Largest value of the first three channels.
[[nodiscard]] double largest_value(const image::HostImage& image);

}  // namespace lightloom::stability
