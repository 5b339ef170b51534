// First part of the pass `emissive_faces`: counts the exposed faces of emissive voxels, one invocation a column of a box.
// A column is counted where voxels of the box or what emitted before lie; rows in which something emits or did are to be
// counted and written again.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/box.glsl"
#include "lib/emissive_columns.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uvec2 count_faces(ivec3 voxel, uint emission) {
  vec3 normal = normal_at(voxel);
  uvec2 sum = uvec2(0u);
  for (uint face = 0u; face < 6u; ++face) {
    if (!exposed(voxel, face)) continue;
    uint weight = face_weight(emission, normal, face);
    sum += uvec2(weight > 0u ? 1u : 0u, weight);
  }
  return sum;
}

void main() {
  if (past_box(box_voxel())) return;
  ivec2 column = box_voxel().xy;
  ivec2 before = column_span(column);
  int first = before.y > 0 ? min(before.x, box_low().z) : box_low().z;
  int end = max(before.y, box_high().z + 1);
  uvec2 sum = uvec2(0u);
  ivec2 span = ivec2(0);
  for (int z = next_emissive(column, first, end); z < end; z = next_emissive(column, z + 1, end)) {
    ivec3 voxel = ivec3(column, z);
    if (voxel_is_empty(voxels_albedo, voxel)) continue;
    sum += count_faces(voxel, emission_at(voxel));
    span = ivec2(span.y > 0 ? span.x : z, z + 1);
  }
  if (before.y == 0 && span.y == 0) return;
  imageStore(columns, column, uvec4(sum, 0u, 0u));
  imageStore(spans, column, uvec4(uint(span.x) | (uint(span.y) << 16u), 0u, 0u, 0u));
  set_row(kRowDirty, column.y, 1u);
}
