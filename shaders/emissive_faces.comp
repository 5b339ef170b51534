// Lists the exposed faces of emissive voxels, one invocation a column of voxels along z: first it counts them, then,
// when shaders/emissive_faces_scan.comp has found where each column's part of the list begins, it writes them. See
// passes/emissive_faces.cpp.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/emissive_faces.glsl"
#include "lib/features.glsl"
#include "lib/voxel_bits.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture3D voxels_albedo;
uniform texture3D voxels_normal;
uniform texture3D voxels_material;
layout(rg32ui) uniform uimage2D columns;
layout(r32ui) uniform uimage2D out_power;
uniform writeonly uimage2D out_faces;

layout(constant_id = 0) const bool writing = false;

// Adds the power of what is visible of one emission entry, in whole numbers so that order does not matter.
void add_power(uint emission, float power) {
  if (!writing && emission > 0u) imageAtomicAdd(out_power, ivec2(emission, 0), uint(power * kFacePowerUnit + 0.5));
}

// Faces that the list has no room for are left out. The last that it has room for says so in the head.
void write_face(uint index, uint code, uint cumulative) {
  if (index >= kFaceCapacity) return;
  imageStore(out_faces, face_texel(index + 1u), uvec4(code, cumulative, 0u, 0u));
  if (index + 1u == kFaceCapacity) imageStore(out_faces, ivec2(0), uvec4(kFaceCapacity, cumulative, 0u, 0u));
}

void main() {
  ivec3 size = textureSize(voxels_albedo, 0);
  ivec2 column = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(column, size.xy))) return;
  // Counting: faces and weight of this column; writing: of all columns before it.
  uvec2 sum = writing ? imageLoad(columns, column).rg : uvec2(0u);
  if (writing && sum.x == kNoFaces) return;
  uint power_emission = 0u;
  float power = 0.0;
  for (int z = 0; has_emissive && z < size.z; ++z) {
    ivec3 voxel = ivec3(column, z);
    uint emission = from_unorm(texelFetch(voxels_material, voxel, 0).a);
    if (emission == 0u || voxel_is_empty(voxels_albedo, voxel)) continue;
    vec3 normal = decode_voxel_normal(texelFetch(voxels_normal, voxel, 0), voxels_normal_bits);
    if (emission != power_emission) {
      add_power(power_emission, power);
      power_emission = emission;
      power = 0.0;
    }
    for (uint face = 0u; face < 6u; ++face) {
      if (!voxel_is_empty(voxels_albedo, voxel + face_normal(face))) continue;
      power += face_emittance(emission, normal, face);
      uint weight = face_weight(emission, normal, face);
      if (weight == 0u) continue;
      if (writing) write_face(sum.x, face_code(voxel, face), sum.y + weight);
      sum += uvec2(1u, weight);
    }
  }
  if (!writing) imageStore(columns, column, uvec4(sum, 0u, 0u));
  add_power(power_emission, power);
}
