// What a triangle contributes to a voxel: its point nearest to the voxel's centre, with textures at the level of detail
// of one voxel.
#ifndef LIGHTLOOM_LIB_VOXEL_SAMPLE
#define LIGHTLOOM_LIB_VOXEL_SAMPLE

#include "lib/grid.glsl"
#include "lib/material.glsl"
#include "lib/triangle.glsl"

Corners grid_corners(Grid grid, Triangle t) {
  Corners world = world_corners(t);
  return Corners(world_to_grid(grid, world.a), world_to_grid(grid, world.b), world_to_grid(grid, world.c));
}

vec3 voxel_barycentric(Corners in_grid, ivec3 voxel) { return nearest_barycentric(vec3(voxel) + 0.5, in_grid); }

TexturePoint voxel_texture_point(Triangle t, Corners in_grid, vec3 barycentric) {
  TexturePoint point;
  point.uv = interpolate_texcoords(t, barycentric);
  texcoord_gradients(t, in_grid, point.dx, point.dy);
  return point;
}

// Is the voxel's point of an alpha-masked triangle cut out?
bool cut_out_in_voxel(Triangle t, Corners in_grid, ivec3 voxel) {
  vec3 barycentric = voxel_barycentric(in_grid, voxel);
  TexturePoint point = voxel_texture_point(t, in_grid, barycentric);
  return cut_out(t.material, material_alpha(t.material, point, interpolate_color(t, barycentric)));
}

#endif
