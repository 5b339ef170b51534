#version 460
#extension GL_GOOGLE_include_directive : require
#include "integer.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
uniform utexture2D x;
uniform writeonly uimage2D out_p_u;
uniform writeonly uimage2D out_p_v;
layout(push_constant) uniform Params { uint salt; };
void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(out_p_u)))) return;
  uint hash = texelFetch(x, pixel, 0).r;
  imageStore(out_p_u, pixel, uvec4(mixed(salt, hash)));
  imageStore(out_p_v, pixel, uvec4(mixed(salt + 1u, hash)));
}
