// Sphere marching through the voxel grid (paper, section 2.2): at a distance of D voxels to the nearest occupied one, a
// ray may move on by D. Distances are chessboard distances, so points less than D further on lie in empty voxels: the
// march finds exactly what unit steps find.
//
// Positions are in grid units: voxel (i, j, k) is [i, i+1) x [j, j+1) x [k, k+1). Directions are unit vectors, so the
// ray parameter counts voxels.
#ifndef LIGHTLOOM_LIB_MARCH
#define LIGHTLOOM_LIB_MARCH

struct MarchHit {
  bool hit;
  ivec3 voxel;
  float t;       // [voxels]; a whole number
};

// How far along its normal a ray has to start to clear the voxels of the plane it starts on: a plane occupies voxels
// whose centres are at most S/2 away, S = |x| + |y| + |z|, and a point lies at most S/2 from the centre of its voxel.
// The hundredth of a voxel keeps rounding from deciding where planes lie on the boundary between voxels.
float surface_clearance(vec3 normal) { return abs(normal.x) + abs(normal.y) + abs(normal.z) + 0.01; }

// Part [x, y] of the ray inside the grid; empty if x > y. A coordinate of the direction that is 0 divides to infinity,
// which the comparisons handle; an origin on the face itself would give NaN and is moved off it.
vec2 clip_to_grid(vec3 origin, vec3 direction, vec3 size) {
  vec3 safe = mix(direction, vec3(1e-20), lessThan(abs(direction), vec3(1e-20)));
  vec3 a = -origin / safe;
  vec3 b = (size - origin) / safe;
  vec3 near = min(a, b);
  vec3 far = max(a, b);
  return vec2(max(max(near.x, near.y), near.z), min(min(far.x, far.y), far.z));
}

// First occupied voxel at t = 0, 1, 2, … up to `end`. `precise`: positions must not depend on how a compiler fuses
// operations, or images would differ between devices.
MarchHit march_ray(texture3D distance_field, vec3 origin, vec3 direction, float end) {
  ivec3 size = textureSize(distance_field, 0);
  vec2 inside = clip_to_grid(origin, direction, vec3(size));
  float last = min(end, inside.y + 1.0);
  float t = ceil(max(inside.x - 1.0, 0.0));
  int limit = size.x + size.y + size.z + 8;
  for (int step_count = 0; step_count < limit && t <= last; ++step_count) {
    precise vec3 position = origin + direction * t;
    ivec3 voxel = ivec3(floor(position));
    float distance_to_surface = 1.0;
    if (all(greaterThanEqual(voxel, ivec3(0))) && all(lessThan(voxel, size))) {
      distance_to_surface = round(texelFetch(distance_field, voxel, 0).r * 255.0);
      if (distance_to_surface == 0.0) return MarchHit(true, voxel, t);
    }
    t += max(distance_to_surface, 1.0);
  }
  return MarchHit(false, ivec3(-1), last);
}

#endif
