// Geometry of the voxel grid. Mirrored by framework/run/grid.cpp, which chooses the extent.
#ifndef LIGHTLOOM_LIB_GRID
#define LIGHTLOOM_LIB_GRID

#include "lib/scene.glsl"

struct Grid {
  vec3 origin;        // world position of the low corner of voxel (0,0,0) [m]
  float voxel_size;   // edge of a voxel [m]
  ivec3 extent;       // voxels
};

float largest_of(vec3 v) { return max(v.x, max(v.y, v.z)); }

// The grid of `extent` voxels around the bounds `low` to `high` [m]; its longest side fits the bounds with one voxel of
// padding at each end.
Grid grid_around(vec3 low, vec3 high, ivec3 extent) {
  high = max(high, low);
  float magnitude = largest_of(max(abs(low), abs(high)));
  float longest = max(largest_of(high - low), max(magnitude * 1e-6, 1e-20));
  Grid grid;
  grid.extent = extent;
  grid.voxel_size = longest / max(largest_of(vec3(extent)) - 2.0, 1.0);
  grid.origin = 0.5 * (low + high) - 0.5 * grid.voxel_size * vec3(extent);
  return grid;
}

Grid scene_grid(ivec3 extent) { return grid_around(frame.scene_min.xyz, frame.scene_max.xyz, extent); }

// World position to grid position: voxel (i,j,k) is the unit cube from (i,j,k) on.
vec3 world_to_grid(Grid grid, vec3 position) { return (position - grid.origin) / grid.voxel_size; }
vec3 grid_to_world(Grid grid, vec3 position) { return grid.origin + position * grid.voxel_size; }

vec3 voxel_center(Grid grid, ivec3 voxel) { return grid_to_world(grid, vec3(voxel) + 0.5); }

bool inside_grid(ivec3 extent, ivec3 voxel) {
  return all(greaterThanEqual(voxel, ivec3(0))) && all(lessThan(voxel, extent));
}

#endif
