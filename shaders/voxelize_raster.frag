// A fragment is the centre of a column of voxels within a triangle's projection; the triangle claims the voxel in which
// its plane meets that line. One atomic maximum, no compare-and-swap: the triangle with the greatest key keeps the voxel,
// whatever the order in which fragments are shaded.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/supercover.glsl"
#include "lib/voxel_owner.glsl"
#include "lib/voxel_sample.glsl"

layout(location = 0) flat in uint index;
layout(location = 1) flat in int axis;
layout(location = 2) flat in vec3 corner;
layout(location = 3) flat in vec2 slope;
layout(location = 4) flat in vec2 reach;

layout(r32ui) uniform uimage3D owner;

void main() {
  ivec3 extent = imageSize(owner);
  vec2 center = floor(gl_FragCoord.xy) + 0.5;
  float height = corner.z + dot(slope, center - corner.xy);
  height = clamp(floor(clamp(height, reach.x, reach.y)), -1.0, float(extent.x + extent.y + extent.z));
  ivec3 voxel = turn_back(ivec3(vec3(center, height)), axis);
  if (!inside_grid(extent, voxel)) return;
  Triangle t = triangle_at(index);
  if (alpha_masked(t.material) && cut_out_in_voxel(t, grid_corners(scene_grid(extent), t), voxel)) return;
  imageAtomicMax(owner, voxel, owner_key(index, t.material));
}
