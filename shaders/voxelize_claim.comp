// Second part of `voxelize` with coverage `supercover`: every triangle claims the voxels it touches; the one with the
// greatest key keeps a voxel. One atomic maximum a voxel, no compare-and-swap loop, so the result does not depend on
// which thread is first.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/supercover.glsl"
#include "lib/voxel_owner.glsl"
#include "lib/voxel_sample.glsl"

layout(local_size_x = 64) in;

layout(r32ui) uniform uimage3D owner;

layout(push_constant) uniform PushBlock {
  uint first_triangle;
  uint triangle_count;
};

// A triangle with more columns is shared out among the threads of its group, and of the groups along z.
const uint kColumnsAlone = 64u;

shared uint large_count;
shared uint large_triangles[gl_WorkGroupSize.x];

void claim(uint index, Triangle t, Corners in_grid, ivec3 voxel) {
  if (alpha_masked(t.material) && cut_out_in_voxel(t, in_grid, voxel)) return;
  imageAtomicMax(owner, voxel, owner_key(index, t.material));
}

void claim_columns(uint index, Triangle t, Corners in_grid, Supercover cover, uint first, uint stride) {
  uint count = column_count(cover);
  for (uint i = first; i < count; i += stride) {
    ivec2 where = column(cover, i);
    if (!column_touched(cover, where)) continue;
    ivec2 span = column_span(cover, where);
    for (int z = span.x; z <= span.y; ++z) {
      ivec3 turned = ivec3(where, z);
      if (voxel_touched(cover, turned)) claim(index, t, in_grid, turn_back(turned, cover.axis));
    }
  }
}

void main() {
  Grid grid = scene_grid(imageSize(owner));
  uint slice = gl_WorkGroupID.z;
  uint slices = gl_NumWorkGroups.z;
  if (gl_LocalInvocationIndex == 0u) large_count = 0u;
  barrier();

  if (gl_GlobalInvocationID.x < triangle_count) {
    uint index = first_triangle + gl_GlobalInvocationID.x;
    Triangle t = triangle_at(index);
    Corners in_grid = grid_corners(grid, t);
    Supercover cover = make_supercover(in_grid, grid.extent);
    // What has been scaled to nothing is a point and has no surface.
    bool vanished = cover.normal == vec3(0.0);
    if (vanished) {
      // Touches voxels, claims none.
    } else if (column_count(cover) > kColumnsAlone) {
      large_triangles[atomicAdd(large_count, 1u)] = index;
    } else if (slice == 0u) {
      claim_columns(index, t, in_grid, cover, 0u, 1u);
    }
  }
  barrier();

  for (uint i = 0u; i < large_count; ++i) {
    uint index = large_triangles[i];
    Triangle t = triangle_at(index);
    Corners in_grid = grid_corners(grid, t);
    Supercover cover = make_supercover(in_grid, grid.extent);
    claim_columns(index, t, in_grid, cover, slice * gl_WorkGroupSize.x + gl_LocalInvocationIndex,
                  slices * gl_WorkGroupSize.x);
  }
}
