// Static and dynamic voxels to one grid. All three words come from the same side.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/box.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture3D static_albedo;
uniform texture3D static_normal;
uniform texture3D static_material;
uniform texture3D dynamic_albedo;
uniform texture3D dynamic_normal;
uniform texture3D dynamic_material;
uniform writeonly image3D out_voxels_albedo;
uniform writeonly image3D out_voxels_normal;
uniform writeonly image3D out_voxels_material;

layout(constant_id = 0) const int priority = 0;
const int kPriorityDynamic = 0;

void main() {
  ivec3 voxel = box_voxel();
  if (past_box(voxel)) return;
  bool take_dynamic = priority == kPriorityDynamic ? texelFetch(dynamic_albedo, voxel, 0).a > 0.5
                                                 : texelFetch(static_albedo, voxel, 0).a <= 0.5;
  if (take_dynamic) {
    imageStore(out_voxels_albedo, voxel, texelFetch(dynamic_albedo, voxel, 0));
    imageStore(out_voxels_normal, voxel, texelFetch(dynamic_normal, voxel, 0));
    imageStore(out_voxels_material, voxel, texelFetch(dynamic_material, voxel, 0));
  } else {
    imageStore(out_voxels_albedo, voxel, texelFetch(static_albedo, voxel, 0));
    imageStore(out_voxels_normal, voxel, texelFetch(static_normal, voxel, 0));
    imageStore(out_voxels_material, voxel, texelFetch(static_material, voxel, 0));
  }
}
