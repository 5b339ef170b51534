// Multiplications and additions of 32-bit floats, in chains that do not wait for each other. Host side:
// framework/study/device_rates.cpp.
#version 460

layout(local_size_x = 64) in;

layout(push_constant) uniform Params {
  uint rounds;   // of 64 operations
  float factor;
  float term;
};

// Never written, which no compiler can know.
layout(std430) buffer Sink { uint sink; };

void main() {
  vec4 x[8];
  for (int i = 0; i < 8; ++i) x[i] = vec4(gl_GlobalInvocationID.x & 63u) * 0.01 + vec4(i);
  for (uint k = 0u; k < rounds; ++k)
    for (int i = 0; i < 8; ++i) x[i] = x[i] * factor + term;
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 8; ++i) sum += x[i];
  if (sum.x + sum.y + sum.z + sum.w == 12345.678) sink = 1u;
}
