// Second part of `voxelize` with coverage `raster`: triangles seen along their dominant axis, one pixel a column of
// voxels. Crassin and Green 2012, "Octree-Based Sparse Voxelization Using the GPU Hardware Rasterizer"; with vertex
// pulling every corner knows the whole triangle, so no geometry shader is needed.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/supercover.glsl"
#include "lib/voxel_sample.glsl"

layout(push_constant) uniform PushBlock {
  int grid_width;
  int grid_height;
  int grid_depth;
  int columns;   // edge of the drawn square [pixels]: the longest side of the grid
};

layout(location = 0) flat out uint index;
layout(location = 1) flat out int axis;
layout(location = 2) flat out vec3 corner;   // of the triangle, coordinates turned so that z is the axis [voxels]
layout(location = 3) flat out vec2 slope;    // of the triangle's plane along the turned x and y
layout(location = 4) flat out vec2 reach;    // least and greatest turned z of the triangle

void main() {
  index = uint(gl_VertexIndex) / 3u;
  uint which = uint(gl_VertexIndex) % 3u;
  Grid grid = scene_grid(ivec3(grid_width, grid_height, grid_depth));
  Supercover cover = make_supercover(grid_corners(grid, triangle_at(index)), grid.extent);
  Corners t = cover.corners;
  axis = cover.axis;
  corner = t.a;
  slope = plane_slope(cover);
  reach = vec2(min(t.a.z, min(t.b.z, t.c.z)), max(t.a.z, max(t.b.z, t.c.z)));
  vec3 position = which == 0u ? t.a : which == 1u ? t.b : t.c;
  gl_Position = vec4(position.xy * (2.0 / float(columns)) - 1.0, 0.5, 1.0);
}
