// Second and last part of the pass `emissive_faces`, a work group a row of columns. Second: sums up the rows that have to
// be counted again, and replaces their share of the power. Last: writes the list from the first of them on.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/emissive_columns.glsl"

const int kInvocations = 64;
const int kLongestRow = 512;
const int kEmissions = 256;
layout(local_size_x = 64) in;

layout(r32ui) uniform uimage2D row_power;   // by emission index, y
layout(r32ui) uniform uimage2D out_power;
uniform writeonly uimage2D out_faces;

layout(constant_id = 0) const bool writing = false;

shared uint powers[kEmissions];
shared uvec2 in_row[kLongestRow];
shared uvec2 run_sums[kInvocations];

// In whole numbers, so that order does not matter.
void add_power(uint emission, float power) {
  if (emission > 0u) atomicAdd(powers[emission], uint(power * kFacePowerUnit + 0.5));
}

void add_column_power(ivec2 column) {
  ivec2 span = column_span(column);
  uint power_emission = 0u;
  float power = 0.0;
  for (int z = next_emissive(column, span.x, span.y); z < span.y; z = next_emissive(column, z + 1, span.y)) {
    ivec3 voxel = ivec3(column, z);
    if (voxel_is_empty(voxels_albedo, voxel)) continue;
    uint emission = emission_at(voxel);
    vec3 normal = normal_at(voxel);
    if (emission != power_emission) {
      add_power(power_emission, power);
      power_emission = emission;
      power = 0.0;
    }
    for (uint face = 0u; face < 6u; ++face)
      if (exposed(voxel, face)) power += face_emittance(emission, normal, face);
  }
  add_power(power_emission, power);
}

void sum_up(int y, int length, int invocation) {
  for (int emission = invocation; emission < kEmissions; emission += kInvocations) powers[emission] = 0u;
  barrier();
  uvec2 sum = uvec2(0u);
  for (int x = invocation; x < length; x += kInvocations) {
    sum += imageLoad(columns, ivec2(x, y)).rg;
    add_column_power(ivec2(x, y));
  }
  run_sums[invocation] = sum;
  barrier();
  if (invocation == 0) {
    for (int other = 1; other < kInvocations; ++other) sum += run_sums[other];
    set_row(kRowFaces, y, sum.x);
    set_row(kRowWeight, y, sum.y);
  }
  for (int emission = invocation; emission < kEmissions; emission += kInvocations) {
    uint before = imageLoad(row_power, ivec2(emission, y)).x;
    if (powers[emission] == before) continue;
    imageAtomicAdd(out_power, ivec2(emission, 0), powers[emission] - before);   // modulo 2^32
    imageStore(row_power, ivec2(emission, y), uvec4(powers[emission], 0u, 0u, 0u));
  }
}

// Turns the columns' own numbers and weights into those of all columns before them.
void scan_row(int y, int length, int invocation) {
  for (int x = invocation; x < length; x += kInvocations) in_row[x] = imageLoad(columns, ivec2(x, y)).rg;
  barrier();
  int run = (length + kInvocations - 1) / kInvocations;
  int first = min(invocation * run, length);
  int end = min(first + run, length);
  uvec2 sum = uvec2(0u);
  for (int x = first; x < end; ++x) sum += in_row[x];
  run_sums[invocation] = sum;
  barrier();
  uvec2 before = uvec2(row_value(kRowFirst, y), row_value(kRowBefore, y));
  for (int other = 0; other < invocation; ++other) before += run_sums[other];
  for (int x = first; x < end; ++x) {
    uvec2 own = in_row[x];
    in_row[x] = before;
    before += own;
  }
  barrier();
}

// Faces that the list has no room for are left out. The last that it has room for says so in the head.
void write_face(uint index, uint code, uint cumulative) {
  if (index >= kFaceCapacity) return;
  imageStore(out_faces, face_texel(index + 1u), uvec4(code, cumulative, 0u, 0u));
  if (index + 1u == kFaceCapacity) imageStore(out_faces, ivec2(0), uvec4(kFaceCapacity, cumulative, 0u, 0u));
}

void write_column(ivec2 column, uvec2 sum) {
  ivec2 span = column_span(column);
  for (int z = next_emissive(column, span.x, span.y); z < span.y; z = next_emissive(column, z + 1, span.y)) {
    ivec3 voxel = ivec3(column, z);
    if (voxel_is_empty(voxels_albedo, voxel)) continue;
    uint emission = emission_at(voxel);
    vec3 normal = normal_at(voxel);
    for (uint face = 0u; face < 6u; ++face) {
      if (!exposed(voxel, face)) continue;
      uint weight = face_weight(emission, normal, face);
      if (weight == 0u) continue;
      write_face(sum.x, face_code(voxel, face), sum.y + weight);
      sum += uvec2(1u, weight);
    }
  }
}

// What follows the last face is 0; all groups share in it.
void clear_rest(int invocation) {
  uint end = row_value(kState, kOldFaces);
  uint stride = gl_NumWorkGroups.y * uint(kInvocations);
  uint first = row_value(kState, kFaces) + gl_WorkGroupID.y * uint(kInvocations) + uint(invocation);
  for (uint index = first; index < end; index += stride) imageStore(out_faces, face_texel(index + 1u), uvec4(0u));
}

void main() {
  int length = textureSize(voxels_albedo, 0).x;
  int y = int(gl_WorkGroupID.y);
  int invocation = int(gl_LocalInvocationID.x);
  if (!writing) {
    if (row_value(kRowDirty, y) != 0u) sum_up(y, length, invocation);
    return;
  }
  clear_rest(invocation);
  if (uint(y) < row_value(kState, kFirstRow) || row_value(kRowFaces, y) == 0u) return;
  scan_row(y, length, invocation);
  for (int x = invocation; x < length; x += kInvocations)
    if (imageLoad(columns, ivec2(x, y)).x > 0u) write_column(ivec2(x, y), in_row[x]);
}
