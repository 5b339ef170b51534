// What an image can hold, by the format that the graph gave it. Constants IMAGE_largest and IMAGE_bits tell it
// (framework/graph/pass_context.hpp).
#ifndef LIGHTLOOM_LIB_STORAGE
#define LIGHTLOOM_LIB_STORAGE

const float kLargestHalf = 65504.0;

// The value as it goes into an image whose channels hold no more than `largest`: an infinity would spread through
// filters and histories. 32-bit floats keep every bit; NaN stays one, for those who look for it.
vec4 storable(vec4 value, float largest) {
  if (largest > kLargestHalf) return value;
  return mix(value, sign(value) * largest, greaterThan(abs(value), vec4(largest)));
}

#endif
