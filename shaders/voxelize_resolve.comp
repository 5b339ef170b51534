// Last part of `voxelize`: every voxel is written from its one owner, so its three words belong together.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/basis.glsl"
#include "lib/box.glsl"
#include "lib/voxel_encoding.glsl"
#include "lib/voxel_owner.glsl"
#include "lib/voxel_sample.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(r32ui) uniform uimage3D owner;
uniform writeonly image3D out_voxels_albedo;
uniform writeonly image3D out_voxels_normal;
uniform writeonly image3D out_voxels_material;

layout(constant_id = 0) const uint out_voxels_albedo_bits = 8u;
layout(constant_id = 1) const uint out_voxels_normal_bits = 8u;
layout(constant_id = 2) const uint out_voxels_material_bits = 8u;

const int kVoxelsAlone = 16;   // as in passes/voxelize.cpp

VoxelSurface surface_in_voxel(Grid grid, Triangle t, ivec3 voxel) {
  Corners in_grid = grid_corners(grid, t);
  vec3 barycentric = voxel_barycentric(in_grid, voxel);
  MaterialSample m = sample_material(t.material, voxel_texture_point(t, in_grid, barycentric),
                                     interpolate_color(t, barycentric));
  vec3 face = safe_normalize(area_normal(in_grid), vec3(0.0, 1.0, 0.0));
  vec3 normal = safe_normalize(interpolate_normal(t, barycentric), face);
  if (dot(normal, face) < 0.0) normal = -normal;
  vec4 tangent = interpolate_tangent(t, barycentric);
  tangent.xyz = orthogonal_tangent(normal, tangent.xyz);
  vec3 bitangent = cross(normal, tangent.xyz) * tangent.w;
  vec3 lobe = tangent.xyz * m.direction.x + bitangent * m.direction.y;

  VoxelSurface s;
  s.albedo = m.base_color;
  s.normal = safe_normalize(tangent.xyz * m.normal.x + bitangent * m.normal.y + normal * m.normal.z, normal);
  s.tangent = orthogonal_tangent(s.normal, lobe);
  s.handedness = tangent.w;
  s.metallic = m.metallic;
  s.ward_alpha = m.ward_alpha;
  s.f0 = m.f0;
  s.f90 = m.f90;
  s.emission = emission_index(t.material, m.emission);
  return s;
}

void resolve(Grid grid, ivec3 voxel) {
  vec4 albedo, normal, material;
  encode_voxel(surface_in_voxel(grid, triangle_at(owner_triangle(imageLoad(owner, voxel).x)), voxel),
               uvec3(out_voxels_albedo_bits, out_voxels_normal_bits, out_voxels_material_bits), albedo, normal, material);
  imageStore(out_voxels_albedo, voxel, albedo);
  imageStore(out_voxels_normal, voxel, normal);
  imageStore(out_voxels_material, voxel, material);
}

int next_claimed(ivec2 column, int z, int end) {
  while (z < end && imageLoad(owner, ivec3(column, z)).x == 0u) ++z;
  return z;
}

// An invocation resolves `kVoxelsAlone` voxels of a column. Few are claimed, and a device that runs a branch for all
// its lanes as soon as one takes it (on a CPU: always) would pay the full price for the empty ones; between the claimed
// ones there is only the cheap search. The outputs were cleared before.
void main() {
  ivec3 last = box_high();
  ivec3 first = box_low() + ivec3(gl_GlobalInvocationID) * ivec3(1, 1, kVoxelsAlone);
  if (past_box(first)) return;
  Grid grid = scene_grid(imageSize(out_voxels_albedo));
  int end = min(first.z + kVoxelsAlone, last.z + 1);
  int z = next_claimed(first.xy, first.z, end);
  do {
    if (z < end) resolve(grid, ivec3(first.xy, z));
    z = next_claimed(first.xy, z + 1, end);
  } while (z < end);
}
