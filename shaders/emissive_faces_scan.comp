// Turns each column's number of faces and their weight into those of all columns before it, and writes the head of the
// list. One work group: each invocation sums a run of columns, the runs are scanned in shared memory.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/emissive_faces.glsl"

const uint kInvocations = 256u;
layout(local_size_x = 256) in;

uniform texture3D voxels_albedo;
layout(rg32ui) uniform uimage2D columns;
uniform writeonly uimage2D out_faces;

shared uvec2 run_sums[kInvocations];

void main() {
  ivec2 size = textureSize(voxels_albedo, 0).xy;
  uint invocation = gl_LocalInvocationID.x;
  uint count = uint(size.x * size.y);
  uint run = (count + kInvocations - 1u) / kInvocations;
  uint first = min(invocation * run, count);
  uint end = min(first + run, count);
  uvec2 sum = uvec2(0u);
  for (uint c = first; c < end; ++c) sum += imageLoad(columns, ivec2(int(c) % size.x, int(c) / size.x)).rg;
  run_sums[invocation] = sum;
  barrier();
  uvec2 before = uvec2(0u);
  for (uint other = 0u; other < invocation; ++other) before += run_sums[other];
  for (uint c = first; c < end; ++c) {
    ivec2 column = ivec2(int(c) % size.x, int(c) / size.x);
    uvec2 own = imageLoad(columns, column).rg;
    imageStore(columns, column, uvec4(own.x > 0u ? before.x : kNoFaces, before.y, 0u, 0u));
    before += own;
  }
  // With more faces than fit, the weight of those that do is only known where the last of them is written.
  if (invocation == kInvocations - 1u) imageStore(out_faces, ivec2(0), uvec4(min(before.x, kFaceCapacity), before.y, 0u, 0u));
}
