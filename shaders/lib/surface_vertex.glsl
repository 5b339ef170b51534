// Where the rays of a surface that the viewer sees start among voxels.
#ifndef LIGHTLOOM_LIB_SURFACE_VERTEX
#define LIGHTLOOM_LIB_SURFACE_VERTEX

#include "lib/grid.glsl"
#include "lib/path_vertex.glsl"
#include "lib/ray_start.glsl"

// The same vertex with its `origin` in grid units, clear of the voxels of its plane.
PathVertex among_voxels(Grid grid, PathVertex vertex) {
  vec3 normal = vertex.geometric_normal;
  vertex.origin = world_to_grid(grid, vertex.position) + normal * start_offset(normal);
  return vertex;
}

#endif
