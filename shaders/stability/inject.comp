// An image as it came, but for one pixel of one frame, which holds what is no number.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/scene.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture2D radiance;
uniform writeonly image2D out_radiance;

layout(push_constant) uniform Params {
  uint x;
  uint y;
  uint bad_frame;
  uint infinite;   // 0: NaN
};

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(out_radiance)))) return;
  vec4 value = texelFetch(radiance, pixel, 0);
  if (pixel == ivec2(x, y) && frame.ids.x == bad_frame)
    value.rgb = vec3(uintBitsToFloat(infinite != 0u ? 0x7F800000u : 0x7FC00000u));
  imageStore(out_radiance, pixel, value);
}
