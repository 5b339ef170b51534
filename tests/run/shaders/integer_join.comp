#version 460
#extension GL_GOOGLE_include_directive : require
#include "integer.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
uniform utexture2D p_u;
uniform utexture2D p_v;
uniform writeonly uimage2D out_a;
layout(push_constant) uniform Params { uint salt; };
void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(out_a)))) return;
  imageStore(out_a, pixel, uvec4(mixed(mixed(salt, texelFetch(p_u, pixel, 0).r), texelFetch(p_v, pixel, 0).r)));
}
