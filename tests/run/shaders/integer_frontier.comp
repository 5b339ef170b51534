#version 460
#extension GL_GOOGLE_include_directive : require
#include "integer.glsl"
#include "lib/scene.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(r32ui) readonly uniform uimage2D memo;
uniform writeonly uimage2D out_a;
layout(push_constant) uniform Params {
  uint salt;
  uint rest;
};
void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(memo))) || (rest == 1u && uint(pixel.x + pixel.y) != frame.ids.x)) return;
  imageStore(out_a, pixel, uvec4(mixed(salt + 1u, imageLoad(memo, pixel).r)));
}
