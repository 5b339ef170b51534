// Marches one pseudo-random ray for each texel and says what it was and what it hit.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/march.glsl"
#include "lib/random.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture3D distance;
uniform writeonly image2D out_origin;
uniform writeonly image2D out_direction;
uniform writeonly image2D out_hit;

layout(push_constant) uniform Params {
  float end;
};

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(out_hit)))) return;
  RandomKey key = RandomKey(uvec2(pixel), 0u, 0u, 0u);
  vec3 size = vec3(textureSize(distance, 0));
  // Some rays start outside, and every eighth runs along an axis.
  vec3 origin = (random4(key, 0u, 0u).xyz * 1.5 - 0.25) * size;
  vec3 direction = normalize(random4(key, 0u, 1u).xyz - 0.5);
  if (((pixel.x + pixel.y) & 7) == 0) direction = vec3(0.0, (pixel.x & 1) == 0 ? 1.0 : -1.0, 0.0);
  MarchHit hit = march_ray(distance, origin, direction, end);
  imageStore(out_origin, pixel, vec4(origin, 0.0));
  imageStore(out_direction, pixel, vec4(direction, 0.0));
  imageStore(out_hit, pixel, vec4(vec3(hit.voxel), hit.hit ? hit.t : -1.0));
}
