#version 460
#extension GL_GOOGLE_include_directive : require
#include "integer.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool y_bound = false;
uniform utexture2D tmp;
uniform utexture2D y;
uniform writeonly uimage2D out_a;
layout(push_constant) uniform Params { uint salt; };
void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  ivec2 size = imageSize(out_a);
  if (any(greaterThanEqual(pixel, size))) return;
  uint hash = mixed(salt + 1u, texelFetch(tmp, ivec2((pixel.x + 1) % size.x, pixel.y), 0).r);
  imageStore(out_a, pixel, uvec4(mixed(hash, y_bound ? texelFetch(y, pixel, 0).r : 77u)));
}
