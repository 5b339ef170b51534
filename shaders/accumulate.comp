// Mean over all frames of a view that stays as it is, and how far it may be off. See passes/accumulate.cpp for the
// ports.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/compensated_sum.glsl"
#include "lib/sampling.glsl"
#include "lib/scene.glsl"
#include "lib/storage.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const bool standard_error_bound = true;
layout(constant_id = 1) const bool standard_error_wanted = true;
layout(constant_id = 2) const float out_radiance_largest = 65504.0;
layout(constant_id = 3) const float out_standard_error_largest = 65504.0;

uniform texture2D radiance;
uniform texture2D standard_error;
uniform texture2D past_sum;
uniform texture2D past_sum_error;
uniform texture2D past_spread;
uniform texture2D past_spread_error;
uniform writeonly image2D out_radiance;
uniform writeonly image2D out_standard_error;
uniform writeonly image2D out_accumulation_sum;
uniform writeonly image2D out_accumulation_sum_error;
uniform writeonly image2D out_accumulation_spread;
uniform writeonly image2D out_accumulation_spread_error;

const float kUnknownError = 1e4;
const float kLargest = 3e38;

struct Accumulation {
  CompensatedSum sum;
  CompensatedSum spread;   // of squared errors: of the frames' own, or of the frames from their mean
  float frames;
  float surfaces;          // frames that saw a surface
  float unknown;           // frames without an error of their own
};

const Accumulation kNoFrames = Accumulation(CompensatedSum(vec3(0.0), vec3(0.0)),
                                            CompensatedSum(vec3(0.0), vec3(0.0)), 0.0, 0.0, 0.0);

bool view_moved() {
  return frame.view_projection[0] != frame.view_projection[1] || frame.eye[0] != frame.eye[1];
}

// Sums that are no numbers would stay so for good, because add_frame then takes every frame for what made them such.
bool is_sound(Accumulation a) {
  return is_finite(value_of(a.sum)) && is_finite(value_of(a.spread)) && is_finite(vec3(a.frames, a.surfaces, a.unknown));
}

// A pixel whose history was spoilt starts anew.
Accumulation read_past(ivec2 pixel) {
  if (view_moved()) return kNoFrames;
  vec4 sum = texelFetch(past_sum, pixel, 0);
  vec4 sum_error = texelFetch(past_sum_error, pixel, 0);
  vec4 spread = texelFetch(past_spread, pixel, 0);
  Accumulation past = Accumulation(CompensatedSum(sum.rgb, sum_error.rgb),
                                   CompensatedSum(spread.rgb, texelFetch(past_spread_error, pixel, 0).rgb), sum.a,
                                   sum_error.a, spread.a);
  return is_sound(past) ? past : kNoFrames;
}

vec3 mean_of(Accumulation a) { return a.frames > 0.0 ? value_of(a.sum) / a.frames : vec3(0.0); }

// Of a single path nobody knows an error, and 0 is given.
bool has_own_error(vec3 own_error) { return standard_error_bound && own_error != vec3(0.0); }

// Without an error of its own: B. P. Welford, "Note on a method for calculating corrected sums of squares and
// products", Technometrics 4(3), 1962. The product's mean is the variance of a frame, whatever their number.
vec3 squared_error(Accumulation before, Accumulation after, vec3 value, vec3 own_error) {
  if (has_own_error(own_error)) return own_error * own_error;
  if (before.frames <= 0.0) return vec3(0.0);
  return (value - mean_of(before)) * (value - mean_of(after));
}

// A frame with a NaN or an infinity is left out, as is one that would make the sums such.
void add_frame(inout Accumulation a, vec4 value, vec3 own_error) {
  Accumulation after = a;
  add(after.sum, value.rgb);
  after.frames += 1.0;
  after.surfaces += value.a > 0.0 ? 1.0 : 0.0;
  after.unknown += has_own_error(own_error) ? 0.0 : 1.0;
  add(after.spread, squared_error(a, after, value.rgb, own_error));
  if (is_finite(value_of(after.sum)) && is_finite(value_of(after.spread))) a = after;
}

vec3 error_of_mean(Accumulation a) {
  vec3 spread = max(value_of(a.spread), vec3(0.0));
  if (a.frames <= 0.0 || (a.frames == 1.0 && !standard_error_bound)) return vec3(kUnknownError);
  // Where no frame has an error, the first of them adds nothing to the spread.
  float terms = a.frames > 1.0 && a.unknown == a.frames ? a.frames - 1.0 : a.frames;
  return sqrt(spread / terms / a.frames);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, textureSize(radiance, 0)))) return;
  Accumulation a = read_past(pixel);
  add_frame(a, texelFetch(radiance, pixel, 0), standard_error_bound ? texelFetch(standard_error, pixel, 0).rgb : vec3(0.0));
  imageStore(out_accumulation_sum, pixel, vec4(a.sum.sum, a.frames));
  imageStore(out_accumulation_sum_error, pixel, vec4(a.sum.error, a.surfaces));
  imageStore(out_accumulation_spread, pixel, vec4(a.spread.sum, a.unknown));
  imageStore(out_accumulation_spread_error, pixel, vec4(a.spread.error, 0.0));
  imageStore(out_radiance, pixel, storable(vec4(mean_of(a), a.surfaces), out_radiance_largest));
  if (standard_error_wanted) imageStore(out_standard_error, pixel, storable(vec4(min(error_of_mean(a), kLargest), a.frames), out_standard_error_largest));
}
