// Marching a ray through the voxel grid, by the chessboard distance D to the nearest occupied voxel.
//
//   sphere      steps of D voxels (paper, section 2.2). A point less than D further on lies in an empty voxel, so this
//               finds exactly what unit steps find, and like them it steps over corners of voxels.
//   cube_exit   steps to where the ray leaves the empty cube of half edge D - 1/2 around its voxel (Sramek and Kaufman
//               2000). Finds every voxel that the ray touches.
//   dda         steps to the next voxel (Amanatides and Woo 1987): cube_exit without distances, which finds the same.
//   box_exit    steps to where the ray leaves the empty box ahead of its voxel (passes/empty_boxes.cpp), and finds the
//               same; march_boxes in march_boxes.glsl.
//
// Positions are in grid units: voxel (i, j, k) is [i, i+1) x [j, j+1) x [k, k+1). Directions are unit vectors, so the
// ray parameter counts voxels. Outside the grid all is empty.
#ifndef LIGHTLOOM_LIB_MARCH
#define LIGHTLOOM_LIB_MARCH

#include "lib/voxel_distance.glsl"

const uint kMarchSphere = 0u;
const uint kMarchCubeExit = 1u;
const uint kMarchDda = 2u;
const uint kMarchBoxExit = 3u;   // cube_exit for those who have no boxes
layout(constant_id = 23) const uint march = 1u;

const float kFarAway = 1e30;   // longer than any ray

// Rays marched so far by this invocation, and distances that they read. Whoever stores them pays for them.
uint rays_marched = 0u;
uint steps_marched = 0u;

struct MarchHit {
  bool hit;
  ivec3 voxel;
  float t;       // [voxels]; where the ray enters the voxel, or (sphere) the whole number at which it was found in it
  ivec3 face;    // outward normal of the face through which the ray enters the voxel
};

// A coordinate of the direction that is 0 divides to infinity, which comparisons handle; an origin on the plane itself
// would give NaN and is moved off it.
vec3 safe_direction(vec3 direction) { return mix(direction, vec3(1e-20), lessThan(abs(direction), vec3(1e-20))); }

// Ray parameters at which the ray enters and leaves the slabs of the box of `size` at the origin.
void box_slabs(vec3 origin, vec3 direction, vec3 size, out vec3 near, out vec3 far) {
  vec3 safe = safe_direction(direction);
  vec3 a = -origin / safe;
  vec3 b = (size - origin) / safe;
  near = min(a, b);
  far = max(a, b);
}

float least_of(vec3 v) { return min(v.x, min(v.y, v.z)); }
float greatest_of(vec3 v) { return max(v.x, max(v.y, v.z)); }

// First axis whose coordinate is `value`.
int axis_of(vec3 v, float value) { return v.x == value ? 0 : v.y == value ? 1 : 2; }

ivec3 face_towards(int axis, vec3 direction) {
  ivec3 face = ivec3(0);
  face[axis] = direction[axis] > 0.0 ? -1 : 1;
  return face;
}

// Face of a voxel through which a ray enters it (or, from within, would have).
ivec3 entry_face(ivec3 voxel, vec3 origin, vec3 direction) {
  vec3 near, far;
  box_slabs(origin - vec3(voxel), direction, vec3(1.0), near, far);
  return face_towards(axis_of(near, greatest_of(near)), direction);
}

bool within(ivec3 voxel, ivec3 size) {
  return all(greaterThanEqual(voxel, ivec3(0))) && all(lessThan(voxel, size));
}

// First occupied voxel at t = 0, 1, 2, … up to `end`. `precise`: positions must not depend on how a compiler fuses
// operations, or images would differ between devices.
MarchHit march_spheres(texture3D distance_field, vec3 origin, vec3 direction, float end) {
  ivec3 size = textureSize(distance_field, 0);
  vec3 near, far;
  box_slabs(origin, direction, vec3(size), near, far);
  float last = min(end, least_of(far) + 1.0);
  float t = ceil(max(greatest_of(near) - 1.0, 0.0));
  int limit = size.x + size.y + size.z + 8;
  bool found = false;
  ivec3 voxel = ivec3(-1);
  // What follows a hit stands after the loop: a CPU device runs all that is in the loop in each round.
  for (int step_count = 0; step_count < limit && t <= last; ++step_count) {
    precise vec3 position = origin + direction * t;
    voxel = ivec3(floor(position));
    int empty = 1;
    if (within(voxel, size)) {
      ++steps_marched;
      empty = voxel_distance(distance_field, voxel);
      found = empty == 0;
    }
    if (found) break;
    t += float(max(empty, 1));
  }
  if (!found) return MarchHit(false, ivec3(-1), last, ivec3(0));
  return MarchHit(true, voxel, t, entry_face(voxel, origin, direction));
}

// Where a ray begins its way through the grid.
struct GridEntry {
  bool enters;   // before its end
  vec3 safe;     // its direction, without zeros
  float t;       // [voxels]
  ivec3 voxel;
  int axis;      // of the face of the grid through which it comes; -1: it starts within
};

GridEntry enter_grid(ivec3 size, vec3 origin, vec3 direction, float end) {
  vec3 safe = safe_direction(direction);
  vec3 near, far;
  box_slabs(origin, direction, vec3(size), near, far);
  precise float t = max(greatest_of(near), 0.0);
  precise vec3 position = origin + direction * t;
  ivec3 voxel = clamp(ivec3(floor(position)), ivec3(0), size - 1);
  int axis = t > 0.0 ? axis_of(near, t) : -1;
  if (axis >= 0) voxel[axis] = safe[axis] > 0.0 ? 0 : size[axis] - 1;
  return GridEntry(t <= least_of(far) && t <= end, safe, t, voxel, axis);
}

// What a march found that came to `voxel` at `t` through a face of `axis`, or started in it (-1).
MarchHit march_end(bool found, ivec3 voxel, float t, int axis, vec3 origin, vec3 direction, float end) {
  if (!found) return MarchHit(false, ivec3(-1), min(end, t), ivec3(0));
  return MarchHit(true, voxel, t, axis >= 0 ? face_towards(axis, direction) : entry_face(voxel, origin, direction));
}

// First occupied voxel that the ray enters up to `end`. Positions follow from the origin alone and voxels are counted
// in whole numbers: on the axis of the exit the next voxel is known, on the others it lies within the cube, whatever
// rounding says.
MarchHit march_cubes(texture3D distance_field, vec3 origin, vec3 direction, float end) {
  ivec3 size = textureSize(distance_field, 0);
  GridEntry entry = enter_grid(size, origin, direction, end);
  if (!entry.enters) return MarchHit(false, ivec3(-1), end, ivec3(0));
  vec3 safe = entry.safe;
  bvec3 forward = greaterThan(safe, vec3(0.0));
  precise float t = entry.t;
  ivec3 voxel = entry.voxel;
  int axis = entry.axis;
  int limit = size.x + size.y + size.z + 8;
  bool found = false;
  for (int step_count = 0; step_count < limit; ++step_count) {
    ++steps_marched;
    int empty = voxel_distance(distance_field, voxel);
    found = empty == 0;
    if (found) break;
    if (march == kMarchDda) empty = 1;
    ivec3 low = voxel - (empty - 1);
    ivec3 high = voxel + (empty - 1);
    precise vec3 exits = (mix(vec3(low), vec3(high + 1), forward) - origin) / safe;
    t = max(t, least_of(exits));
    axis = axis_of(exits, least_of(exits));
    if (t > end) break;
    precise vec3 exit_position = origin + direction * t;
    ivec3 next = ivec3(floor(exit_position));
    next = clamp(next, mix(low, voxel, forward), mix(voxel, high, forward));
    next[axis] = forward[axis] ? high[axis] + 1 : low[axis] - 1;
    if (!within(next, size)) break;
    voxel = next;
  }
  return march_end(found, voxel, t, axis, origin, direction, end);
}

MarchHit march_ray(texture3D distance_field, vec3 origin, vec3 direction, float end) {
  ++rays_marched;
  return march == kMarchSphere ? march_spheres(distance_field, origin, direction, end)
                               : march_cubes(distance_field, origin, direction, end);
}

// Where the ray enters the voxel that it hit [voxels].
float entry_distance(MarchHit hit, vec3 origin, vec3 direction) {
  vec3 plane = vec3(hit.voxel) + max(vec3(hit.face), vec3(0.0)) - origin;
  vec3 along = abs(vec3(hit.face));
  float speed = dot(along, direction);
  return speed != 0.0 ? dot(along, plane) / speed : 0.0;
}

#endif
