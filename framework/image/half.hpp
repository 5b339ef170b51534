#pragma once

#include <cstdint>

namespace lightloom::image {

/// IEEE 754 binary16 to binary32, exact for every input; NaN payloads are kept.
[[nodiscard]] float float_from_half(uint16_t half);

/// binary32 to the nearest binary16, ties to even; what is too large becomes infinity.
[[nodiscard]] uint16_t half_from_float(float value);

}  // namespace lightloom::image
