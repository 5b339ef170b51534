#version 460
#extension GL_GOOGLE_include_directive : require
#include "integer.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
uniform utexture2D x;
uniform utexture2DArray past;
uniform writeonly uimage2D out_a;
layout(push_constant) uniform Params {
  uint salt;
  uint past_count;
  uint past_first_age;
  uint past_ring;
  uint past_newest_layer;
};
void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(out_a)))) return;
  uint hash = mixed(salt, texelFetch(x, pixel, 0).r);
  for (uint i = 0u; i < past_count; ++i) {
    uint layer = (past_newest_layer + past_ring - (past_first_age + i)) % past_ring;
    hash = mixed(hash, texelFetch(past, ivec3(pixel, layer), 0).r);
  }
  imageStore(out_a, pixel, uvec4(hash));
}
