// First part of `voxelize` where only a box is voxelized again: empties the box.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/box.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(r32ui) uniform writeonly uimage3D owner;
uniform writeonly image3D out_voxels_albedo;
uniform writeonly image3D out_voxels_normal;
uniform writeonly image3D out_voxels_material;

void main() {
  ivec3 voxel = box_voxel();
  if (past_box(voxel)) return;
  imageStore(owner, voxel, uvec4(0u));
  imageStore(out_voxels_albedo, voxel, vec4(0.0));
  imageStore(out_voxels_normal, voxel, vec4(0.0));
  imageStore(out_voxels_material, voxel, vec4(0.0));
}
