// What random bits become at the ends of their range: texel x holds the number made of bits x * 0xffffffff / 3.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/random.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform writeonly image2D out_numbers;

void main() {
  if (gl_GlobalInvocationID.x >= 4u || gl_GlobalInvocationID.y >= 1u) return;
  uint bits = gl_GlobalInvocationID.x * 0x55555555u;
  imageStore(out_numbers, ivec2(gl_GlobalInvocationID.xy), uniform_floats(uvec4(bits)));
}
