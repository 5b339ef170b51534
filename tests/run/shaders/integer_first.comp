#version 460
#extension GL_GOOGLE_include_directive : require
#include "integer.glsl"
// The first of two commands: `tmp` is what the second one reads at another texel.
layout(local_size_x = 8, local_size_y = 8) in;
uniform utexture2D x;
uniform writeonly uimage2D tmp;
layout(push_constant) uniform Params { uint salt; };
void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(tmp)))) return;
  imageStore(tmp, pixel, uvec4(mixed(salt, texelFetch(x, pixel, 0).r)));
}
