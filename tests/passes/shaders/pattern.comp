// Images with known contents, for the tests of filters.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/random.glsl"
#include "lib/scene.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture2D surface_position;
uniform texture2D surface_normal;
uniform utexture2D surface_id;
uniform writeonly image2D out_radiance;

layout(push_constant) uniform Params {
  uint pattern;   // 0 constant, 1 noise, 2 impulse, 3 normal, 4 object, 5 ramp, 6 frame, 7 spoilt, 8 bump,
                  // 9 step (alpha 10, as after ten frames), 10 texture
  float scale;
};

vec3 value(ivec2 pixel, ivec2 size) {
  if (pattern == 1u) return random4(RandomKey(uvec2(pixel), frame.ids.x, frame.ids.y, 0u, 1u), 7u, 7u).xyz;
  if (pattern == 2u) return pixel == size / 2 ? vec3(1.0) : vec3(0.0);
  if (pattern == 3u) return abs(texelFetch(surface_normal, pixel, 0).xyz);
  if (pattern == 4u) return texelFetch(surface_id, pixel, 0).x == 1u ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
  if (pattern == 5u) return vec3(float(pixel.x) / 16.0, float(pixel.y) / 16.0, 2.0);
  if (pattern == 6u) return vec3(float(frame.ids.x & 1u));
  if (pattern == 7u) return pixel == size / 2 ? vec3(uintBitsToFloat(0x7FC00000u)) : vec3(1.0);
  if (pattern == 8u) return vec3(pixel == size / 2 ? 1.0078125 : 1.0);
  if (pattern == 9u) return vec3(pixel.x < size.x / 2 ? 1.0 : 2.0);
  if (pattern == 10u) {   // coordinates on a square of two triangles that share the corners 0 and 2
    uvec4 id = texelFetch(surface_id, pixel, 0);
    vec2 w = unpackUnorm2x16(id.w);
    return (id.z & 1u) == 0u ? vec3(w.x + w.y, w.y, 0.0) : vec3(w.x, w.x + w.y, 0.0);
  }
  return vec3(0.25, 0.5, 2.0);
}

void main() {
  ivec2 size = textureSize(surface_position, 0);
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, size))) return;
  bool background = texelFetch(surface_position, pixel, 0).w <= 0.0;
  imageStore(out_radiance, pixel, vec4(scale * value(pixel, size), background ? 0.0 : pattern == 9u ? 10.0 : 1.0));
}
