// Copies a storage buffer, as often as there are groups along z. Host side: framework/study/device_rates.cpp.
#version 460

layout(local_size_x = 64) in;

layout(push_constant) uniform Params { uint count; };   // of 16 bytes each

layout(std430) readonly buffer Source { uvec4 from[]; };
layout(std430) writeonly buffer Target { uvec4 to[]; };

void main() {
  if (gl_GlobalInvocationID.x < count) to[gl_GlobalInvocationID.x] = from[gl_GlobalInvocationID.x];
}
