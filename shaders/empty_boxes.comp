// Grows empty boxes along one axis: each thread walks a row of voxels from the far end of the rays that its boxes are
// for. See passes/empty_boxes.cpp.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/empty_box.glsl"
#include "lib/voxel_distance.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture3D distance;
layout(r32ui) uniform uimage3D out_boxes;

layout(constant_id = 0) const int axis = 0;

// What a box is worth to a ray that starts in its near corner: the harmonic mean, for a long edge does not make up for
// short ones.
float box_score(ivec3 edges) { return 1.0 / (1.0 / float(edges.x) + 1.0 / float(edges.y) + 1.0 / float(edges.z)); }

// The cube that the distance promises. No box reaches out of the grid, so that a ray in a box is in the grid.
ivec3 first_box(int empty, ivec3 voxel, ivec3 size, bvec3 falling) {
  return min(ivec3(min(empty, kLongestEdge)), mix(size - voxel, voxel + 1, falling));
}

uint first_texel(ivec3 voxel, ivec3 size, bvec2 falling) {
  int empty = voxel_distance(distance, voxel);
  return (pack_box(first_box(empty, voxel, size, bvec3(false, falling))) << box_shift(false)) |
         (pack_box(first_box(empty, voxel, size, bvec3(true, falling))) << box_shift(true));
}

// The better of a box and of its first slice together with the box behind that.
ivec3 grown(ivec3 own, ivec3 ahead) {
  if (own == ivec3(0) || ahead == ivec3(0)) return own;
  ivec3 joined = min(own, ahead);
  joined[axis] = min(ahead[axis] + 1, kLongestEdge);
  return box_score(joined) > box_score(own) ? joined : own;
}

// The same for one box of a texel; `ahead` is the texel next to it.
uint grown_texel(uint texel, uint ahead, int shift) {
  ivec3 box = grown(unpack_box(box_of(texel, shift)), unpack_box(box_of(ahead, shift)));
  return bitfieldInsert(texel, pack_box(box), shift, 15);
}

// The boxes of rays that fall along the axis, or of those that rise.
void grow_row(ivec3 voxel, ivec3 size, bvec2 falling, bool falls) {
  ivec3 block = box_block(size, bvec3(false, falling));
  uint ahead = 0u;
  for (int k = 0; k < size[axis]; ++k) {
    voxel[axis] = falls ? k : size[axis] - 1 - k;
    uint texel = axis == 0 && !falls ? first_texel(voxel, size, falling) : imageLoad(out_boxes, block + voxel).r;
    if (axis != 0 || !falls) texel = grown_texel(texel, ahead, box_shift(false));
    if (axis != 0 || falls) texel = grown_texel(texel, ahead, box_shift(true));
    imageStore(out_boxes, block + voxel, uvec4(texel));
    ahead = texel;
  }
}

void main() {
  ivec3 size = textureSize(distance, 0);
  ivec2 row = ivec2(gl_GlobalInvocationID.xy);
  bvec2 falling = bvec2((gl_GlobalInvocationID.z & 1u) != 0u, (gl_GlobalInvocationID.z & 2u) != 0u);
  ivec3 voxel = axis == 0 ? ivec3(0, row) : axis == 1 ? ivec3(row.x, 0, row.y) : ivec3(row, 0);
  if (any(greaterThanEqual(voxel, size))) return;
  if (axis == 0) {
    grow_row(voxel, size, falling, false);
    grow_row(voxel, size, falling, true);
  } else {
    grow_row(voxel, size, falling, axis == 1 ? falling.x : falling.y);
  }
}
