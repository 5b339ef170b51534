#version 460
#extension GL_GOOGLE_include_directive : require
#include "integer.glsl"
// Every second texel; the others keep what they were cleared to.
layout(local_size_x = 8, local_size_y = 8) in;
uniform utexture2D x;
uniform writeonly uimage2D out_a;
layout(push_constant) uniform Params { uint salt; };
void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(out_a))) || (pixel.x + pixel.y) % 2 == 1) return;
  imageStore(out_a, pixel, uvec4(mixed(salt, texelFetch(x, pixel, 0).r)));
}
