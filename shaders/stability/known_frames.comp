// Frames of known statistics: uniform noise of a width around a mean, independent from pixel to pixel and frame to
// frame; in one pixel of one frame something else.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/random.glsl"
#include "lib/scene.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform writeonly image2D out_radiance;

layout(push_constant) uniform Params {
  float mean;
  float width;
  uint bad_frame;
  uint bad_bits;   // 0: no bad pixel; 1: NaN; 2: infinity; 3: -infinity
};

float bad_value() { return uintBitsToFloat(bad_bits == 1u ? 0x7FC00000u : bad_bits == 2u ? 0x7F800000u : 0xFF800000u); }

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(out_radiance)))) return;
  RandomKey key = RandomKey(uvec2(pixel), frame.ids.x, frame.ids.y, 0u, 1u);
  vec3 value = vec3(mean) + width * (random4(key, 0u, 0u).xyz - 0.5);
  if (bad_bits != 0u && pixel == ivec2(1, 2) && frame.ids.x == bad_frame) value = vec3(bad_value());
  imageStore(out_radiance, pixel, vec4(value, 1.0));
}
