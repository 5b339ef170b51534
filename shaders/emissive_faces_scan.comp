// Third part of the pass `emissive_faces`: finds where each row's part of the list begins and what of the list changes,
// and writes its head. One work group: each invocation sums a run of rows, the runs are scanned in shared memory. Run
// once more after the list is written, it forgets what changed: what is kept for the next frame must not tell how it
// came about.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/emissive_columns.glsl"

const int kInvocations = 64;
layout(local_size_x = 64) in;

uniform writeonly uimage2D out_faces;

layout(constant_id = 0) const bool finishing = false;

shared uvec2 run_sums[kInvocations];
shared uint first_dirty;

void main() {
  int invocation = int(gl_LocalInvocationID.x);
  if (finishing) {
    if (invocation == kFirstRow || invocation == kOldFaces) set_row(kState, invocation, 0u);
    return;
  }
  int count = textureSize(voxels_albedo, 0).y;
  int run = (count + kInvocations - 1) / kInvocations;
  int first = min(invocation * run, count);
  int end = min(first + run, count);
  if (invocation == 0) first_dirty = kNoRow;
  barrier();
  uvec2 sum = uvec2(0u);
  for (int y = first; y < end; ++y) {
    sum += uvec2(row_value(kRowFaces, y), row_value(kRowWeight, y));
    if (row_value(kRowDirty, y) == 0u) continue;
    atomicMin(first_dirty, uint(y));
    set_row(kRowDirty, y, 0u);
  }
  run_sums[invocation] = sum;
  barrier();
  uvec2 before = uvec2(0u);
  for (int other = 0; other < invocation; ++other) before += run_sums[other];
  for (int y = first; y < end; ++y) {
    set_row(kRowFirst, y, before.x);
    set_row(kRowBefore, y, before.y);
    before += uvec2(row_value(kRowFaces, y), row_value(kRowWeight, y));
  }
  if (invocation != kInvocations - 1) return;
  // With more faces than fit, the weight of those that do is only known where the last of them is written.
  bool full = before.x > kFaceCapacity;
  set_row(kState, kFirstRow, full && first_dirty != kNoRow ? 0u : first_dirty);
  set_row(kState, kOldFaces, row_value(kState, kFaces));
  set_row(kState, kFaces, min(before.x, kFaceCapacity));
  if (first_dirty == kNoRow) return;
  imageStore(out_faces, ivec2(0), uvec4(min(before.x, kFaceCapacity), before.y, 0u, 0u));
}
