// Each frame one diagonal of the kept image appears; the first frame writes all of it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "integer.glsl"
#include "lib/scene.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(r32ui) uniform uimage2D memo;
layout(push_constant) uniform Params {
  uint salt;
  uint rest;
};
void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  uint due = uint(pixel.x + pixel.y);
  if (any(greaterThanEqual(pixel, imageSize(memo))) || (rest == 1u && due != frame.ids.x)) return;
  imageStore(memo, pixel, uvec4(due <= frame.ids.x ? mixed(mixed(salt, uint(pixel.x)), uint(pixel.y)) : 0u));
}
