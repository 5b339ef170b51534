#pragma once

#include "framework/image/compared_images.hpp"

namespace lightloom::image {

/// Mean structural similarity of the luminances (Wang, Bovik, Sheikh, Simoncelli 2004): window of 11x11 Gaussian
/// weights of sigma 1.5 pixels, K1 = 0.01, K2 = 0.03, values from 0 to 1. Only windows that lie within the image and
/// whose middle pixel is usable; where a side of the image is shorter than 11, the window has that length. NaN where
/// there is no such window. 1 for equal images.
[[nodiscard]] double mean_ssim(const ComparedImages& images, unsigned threads);

}  // namespace lightloom::image
