// How well the radiance of a pixel is known.
#ifndef LIGHTLOOM_LIB_RELATIVE_ERROR
#define LIGHTLOOM_LIB_RELATIVE_ERROR

#include "lib/color.glsl"
#include "lib/sampling.glsl"

uniform texture2D radiance;
uniform texture2D variance;
uniform utexture2D surface_id;

const float kUnknownError = 1e18;

// Relative standard error of a pixel's radiance. Mean and variance are themselves estimates of few samples, and both are
// small where by chance no light was found; so they are taken over the 3x3 pixels around, as far as they show the same
// object.
float relative_error(ivec2 centre, uint object) {
  ivec2 last = textureSize(radiance, 0) - 1;
  vec3 sum = vec3(0.0);   // luminance, its variance, pixels
  for (int k = 0; k < 9; ++k) {
    ivec2 pixel = clamp(centre + ivec2(k % 3, k / 3) - 1, ivec2(0), last);
    vec4 value = texelFetch(radiance, pixel, 0);
    vec3 moments = vec3(luminance(value.rgb), texelFetch(variance, pixel, 0).x, 1.0);
    bool counts = all(bvec3(texelFetch(surface_id, pixel, 0).x == object, value.a > 0.0, is_finite(moments)));
    sum += counts ? max(moments, vec3(0.0)) : vec3(0.0);
  }
  // Nothing found, nothing known.
  return sum.x > 0.0 ? min(sqrt(sum.y * sum.z) / sum.x, kUnknownError) : kUnknownError;
}

#endif
