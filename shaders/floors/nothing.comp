// Invocations that do nothing. Host side: framework/study/device_rates.cpp.
#version 460

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant) uniform Params { uint never; };   // a number that no invocation has

// Never written, which no compiler can know.
layout(std430) buffer Sink { uint sink; };

void main() {
  if (gl_GlobalInvocationID.x == never) sink = 1u;
}
