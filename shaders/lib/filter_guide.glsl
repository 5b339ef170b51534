// What the spatial filters ask of a neighbour, in one texel of 128 bits: 24 bits of the object and 8 of the error, whose
// logarithm is stored; the point (lib/packed_point.glsl); above it the upper half of the variance as a float.
#ifndef LIGHTLOOM_LIB_FILTER_GUIDE
#define LIGHTLOOM_LIB_FILTER_GUIDE

#include "lib/packed_point.glsl"

struct Guide {
  uint object;      // 0: background; objects 2^24 apart are told for one
  SurfacePoint point;
  float variance;   // of the luminance, within 1/256 of itself
  float error;      // relative standard error of the radiance (lib/relative_error.glsl), within 1/40 of itself
};

// Errors from 2^-9 to 2^7, 16 steps for a factor of 2; what lies outside is full or no length to every filter.
const float kErrorSteps = 16.0;
const float kErrorOffset = 144.0;

uvec4 pack_guide(Guide guide) {
  uvec3 point = pack_point(guide.point);
  uint variance = (floatBitsToUint(guide.variance) + 0x8000u) >> 16u;
  uint error = uint(clamp(round(log2(max(guide.error, 1e-30)) * kErrorSteps + kErrorOffset), 0.0, 255.0));
  return uvec4((guide.object & 0xFFFFFFu) | error << 24u, point.xy, point.z | variance << 16u);
}

Guide unpack_guide(uvec4 packed) {
  return Guide(packed.x & 0xFFFFFFu, unpack_point(packed.yzw), uintBitsToFloat(packed.w & 0xFFFF0000u),
               exp2((float(packed.x >> 24u) - kErrorOffset) / kErrorSteps));
}

#endif
