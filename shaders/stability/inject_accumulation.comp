// What `accumulate` left a frame ago as it was, but for one channel of one pixel in one frame, which is no number.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/scene.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture2D past_sum;
uniform texture2D past_sum_error;
uniform texture2D past_spread;
uniform texture2D past_spread_error;
uniform writeonly image2D out_accumulation_sum;
uniform writeonly image2D out_accumulation_sum_error;
uniform writeonly image2D out_accumulation_spread;
uniform writeonly image2D out_accumulation_spread_error;

layout(push_constant) uniform Params {
  uint bad_frame;
  uint part;       // 0: sum, 1: sum_error, 2: spread, 3: spread_error
  uint channel;
  uint infinite;   // 0: NaN
};

vec4 spoilt(vec4 value, ivec2 pixel, uint which) {
  if (pixel == ivec2(1, 2) && frame.ids.x == bad_frame && part == which)
    value[channel] = uintBitsToFloat(infinite != 0u ? 0x7F800000u : 0x7FC00000u);
  return value;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(out_accumulation_sum)))) return;
  imageStore(out_accumulation_sum, pixel, spoilt(texelFetch(past_sum, pixel, 0), pixel, 0u));
  imageStore(out_accumulation_sum_error, pixel, spoilt(texelFetch(past_sum_error, pixel, 0), pixel, 1u));
  imageStore(out_accumulation_spread, pixel, spoilt(texelFetch(past_spread, pixel, 0), pixel, 2u));
  imageStore(out_accumulation_spread_error, pixel, spoilt(texelFetch(past_spread_error, pixel, 0), pixel, 3u));
}
