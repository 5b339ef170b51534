// Marches one pseudo-random ray for each texel and says what it was and what it hit. One in eight each: along an axis,
// within a plane of the grid, from a corner of voxels, along a diagonal from a corner; from far outside; three random.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/march_boxes.glsl"
#include "lib/random.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture3D distance;
uniform writeonly image2D out_origin;
uniform writeonly image2D out_direction;
uniform writeonly image2D out_hit;
uniform writeonly image2D out_face;

layout(push_constant) uniform Params {
  float end;
  uint salt;
};

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(out_hit)))) return;
  RandomKey key = RandomKey(uvec2(pixel), salt, 0u, 0u, 1u);
  vec3 size = vec3(textureSize(distance, 0));
  vec4 u = random4(key, 0u, 1u);
  int kind = (pixel.x + pixel.y) & 7;
  // Some rays start outside.
  vec3 origin = (random4(key, 0u, 0u).xyz * 1.5 - 0.25) * size;
  vec3 direction = normalize(u.xyz - 0.5);
  vec3 signs = mix(vec3(-1.0), vec3(1.0), greaterThan(u.xyz, vec3(0.5)));
  int axis = int(u.w * 3.0);
  if (kind == 0) {
    direction = vec3(0.0);
    direction[axis] = signs.x;
  }
  if (kind == 1) {
    direction[axis] = 0.0;
    direction = normalize(direction);
  }
  if (kind == 2 || kind == 3) origin = floor(origin);
  if (kind == 3) direction = normalize(signs);
  if (kind == 4) {
    origin = (u.zxy * 20.0 - 10.0) * size;
    direction = normalize(random4(key, 0u, 2u).xyz * size - origin);
  }
  MarchHit hit = march_grid(distance, origin, direction, end);
  imageStore(out_origin, pixel, vec4(origin, 0.0));
  imageStore(out_direction, pixel, vec4(direction, entry_distance(hit, origin, direction)));
  imageStore(out_hit, pixel, vec4(vec3(hit.voxel), hit.hit ? hit.t : -1.0));
  imageStore(out_face, pixel, vec4(vec3(hit.face), float(steps_marched)));
}
