// Marching a ray through the voxel grid by empty boxes ahead of it, where a pass has them.
#ifndef LIGHTLOOM_LIB_MARCH_BOXES
#define LIGHTLOOM_LIB_MARCH_BOXES

#include "lib/empty_box.glsl"
#include "lib/march.glsl"

uniform utexture3D boxes;
layout(constant_id = 27) const bool boxes_bound = false;

// As march_cubes; the box reaches from the voxel to where the ray goes. Whole numbers are kept as floats, which hold
// them exactly and spare conversions.
MarchHit march_boxes(ivec3 size, vec3 origin, vec3 direction, float end) {
  GridEntry entry = enter_grid(size, origin, direction, end);
  if (!entry.enters) return MarchHit(false, ivec3(-1), end, ivec3(0));
  vec3 safe = entry.safe;
  bvec3 forward = greaterThan(safe, vec3(0.0));
  precise float t = entry.t;
  vec3 voxel = vec3(entry.voxel);
  int axis = entry.axis;
  bvec3 falling = not(forward);
  vec3 way = mix(vec3(-1.0), vec3(1.0), forward);
  vec3 far_side = mix(vec3(1.0), vec3(0.0), forward);
  vec3 block = vec3(box_block(size, falling));
  int shift = box_shift(falling.x);
  int limit = size.x + size.y + size.z + 8;
  bool found = false;
  for (int step_count = 0; step_count < limit; ++step_count) {
    ++steps_marched;
    uint code = box_of(texelFetch(boxes, ivec3(voxel + block), 0).r, shift);
    found = code == 0u;
    if (found) break;
    vec3 edges = vec3(unpack_box(code));
    vec3 beyond = voxel + way * edges;
    precise vec3 exits = (beyond + far_side - origin) / safe;
    float least = least_of(exits);
    t = max(t, least);
    axis = axis_of(exits, least);
    if (t > end) break;
    precise vec3 exit_position = origin + direction * t;
    vec3 last = beyond - way;
    vec3 next = clamp(floor(exit_position), min(voxel, last), max(voxel, last));
    next = mix(next, beyond, equal(ivec3(axis), ivec3(0, 1, 2)));
    if (any(lessThan(next, vec3(0.0))) || any(greaterThanEqual(next, vec3(size)))) break;
    voxel = next;
  }
  return march_end(found, ivec3(voxel), t, axis, origin, direction, end);
}

// First occupied voxel on a ray, by the boxes where there are some.
MarchHit march_grid(texture3D distance_field, vec3 origin, vec3 direction, float end) {
  if (march != kMarchBoxExit || !boxes_bound) return march_ray(distance_field, origin, direction, end);
  ++rays_marched;
  return march_boxes(textureSize(distance_field, 0), origin, direction, end);
}

#endif
