// Static and dynamic voxels to one grid. All three words come from the same side; each may be of another width.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/box.glsl"
#include "lib/voxel_encoding.glsl"

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
layout(constant_id = 1) const uint static_normal_bits = 8u;
layout(constant_id = 2) const uint dynamic_normal_bits = 8u;
layout(constant_id = 3) const uint out_voxels_normal_bits = 8u;

void main() {
  ivec3 voxel = box_voxel();
  if (past_box(voxel)) return;
  bool take_dynamic = priority == kPriorityDynamic ? texelFetch(dynamic_albedo, voxel, 0).a > 0.5
                                                 : texelFetch(static_albedo, voxel, 0).a <= 0.5;
  vec4 albedo = take_dynamic ? texelFetch(dynamic_albedo, voxel, 0) : texelFetch(static_albedo, voxel, 0);
  vec4 normal = take_dynamic ? texelFetch(dynamic_normal, voxel, 0) : texelFetch(static_normal, voxel, 0);
  vec4 material = take_dynamic ? texelFetch(dynamic_material, voxel, 0) : texelFetch(static_material, voxel, 0);
  if (voxel_occupied(albedo))   // what is empty is 0 in every width
    normal = recode_voxel_normal(normal, take_dynamic ? dynamic_normal_bits : static_normal_bits, out_voxels_normal_bits);
  imageStore(out_voxels_albedo, voxel, albedo);
  imageStore(out_voxels_normal, voxel, normal);
  imageStore(out_voxels_material, voxel, material);
}
