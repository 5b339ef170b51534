// Chains of texel fetches from a volume, each of which must be back before the next one can start: what a ray does
// that marches, with as little around it as possible. Host side: framework/study/device_rates.cpp.
#version 460
#extension GL_EXT_samplerless_texture_functions : require

layout(local_size_x = 8, local_size_y = 8) in;

// Next to each other, like the rays of a picture, or anywhere.
layout(constant_id = 0) const bool scattered = false;

layout(push_constant) uniform Params { uint fetches; };   // of each invocation

uniform texture3D volume;   // sides are powers of 2
// Never written, which no compiler can know.
layout(std430) buffer Sink { uint sink; };

void main() {
  ivec3 wrap = textureSize(volume, 0) - 1;
  uint sum = 0u;
  if (scattered) {
    uint place = (gl_GlobalInvocationID.x * 1973u + gl_GlobalInvocationID.y * 9277u + gl_GlobalInvocationID.z) * 26699u;
    for (uint i = 0u; i < fetches; ++i) {
      ivec3 texel = ivec3(place, place >> 9u, place >> 18u) & wrap;
      place = place * 747796405u + 2891336453u + uint(texelFetch(volume, texel, 0).r * 255.0);
    }
    sum = place;
  } else {
    vec2 picture = vec2(gl_NumWorkGroups.xy * gl_WorkGroupSize.xy);
    vec3 position = vec3(vec2(gl_GlobalInvocationID.xy) / picture, 0.0) * vec3(wrap + 1);
    vec3 direction = vec3(0.2, 0.3, 0.933);
    for (uint i = 0u; i < fetches; ++i) {
      float clearance = round(texelFetch(volume, ivec3(position) & wrap, 0).r * 255.0);
      position += direction * clearance;
    }
    sum = uint(position.x + position.y + position.z);
  }
  if (sum == 4294967295u) sink = 1u;
}
