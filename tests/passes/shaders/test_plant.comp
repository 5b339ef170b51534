// Its input, but for one pixel of one frame, which gets the bits of a NaN (kind 0) or an infinity (kind 1).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/scene.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
uniform texture2D x;
layout(r32f) uniform writeonly image2D out_y;
layout(push_constant) uniform Params { int column; int row; int in_frame; int kind; };
void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(out_y)))) return;
  float value = texelFetch(x, pixel, 0).r;
  if (pixel == ivec2(column, row) && int(frame.ids.x) == in_frame)
    value = uintBitsToFloat(kind == 0 ? 0x7fc00000u : 0x7f800000u);
  imageStore(out_y, pixel, vec4(value, 0.0, 0.0, 0.0));
}
