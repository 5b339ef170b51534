// Where the rays of a surface start in the voxel grid.
#ifndef LIGHTLOOM_LIB_RAY_START
#define LIGHTLOOM_LIB_RAY_START

// How far along its normal a ray has to start to clear the voxels of the plane it starts on: a plane occupies voxels
// whose centres are at most S/2 away, S = |x| + |y| + |z|, and a point lies at most S/2 from the centre of its voxel.
// The hundredth of a voxel keeps rounding from deciding where planes lie on the boundary between voxels.
float surface_clearance(vec3 normal) { return abs(normal.x) + abs(normal.y) + abs(normal.z) + 0.01; }

const uint kStartClearance = 0u;
const uint kStartSqrt3 = 1u;
layout(constant_id = 26) const uint start = 0u;

// How far along its normal the rays of a surface start. sqrt(3) voxels are the paper's author's, for all directions.
float start_offset(vec3 normal) { return start == kStartSqrt3 ? 1.7320508 : surface_clearance(normal); }

#endif
