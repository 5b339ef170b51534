// Column x is 1 + x up to the frame's number, 0 beyond. `columns` = 1: writes the one column that is new in this frame.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/scene.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
uniform writeonly image2D out_front;
layout(r32ui) uniform uimage2D memo;
layout(push_constant) uniform Params { uint columns; };
void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (columns == 1u) pixel.x += int(frame.ids.x);
  if (any(greaterThanEqual(pixel, imageSize(memo))) || gl_GlobalInvocationID.x >= columns) return;
  uint value = pixel.x <= int(frame.ids.x) ? 1u + uint(pixel.x) : 0u;
  imageStore(out_front, pixel, vec4(float(value), 0.0, 0.0, 0.0));
  imageStore(memo, pixel, uvec4(10u * value));
}
