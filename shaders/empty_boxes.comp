// Grows empty boxes along one axis: each thread walks a row of voxels from the far end of the rays that go up the row,
// and back for those that go down. See passes/empty_boxes.cpp.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/empty_box.glsl"
#include "lib/voxel_distance.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture3D distance;
layout(rgba32ui) uniform uimage3D out_boxes;

layout(constant_id = 0) const int axis = 0;

// What a box is worth to a ray that starts in its near corner: the harmonic mean, for a long edge does not make up for
// short ones.
float box_score(ivec3 edges) { return 1.0 / (1.0 / float(edges.x) + 1.0 / float(edges.y) + 1.0 / float(edges.z)); }

// The cube that the distance promises. No box reaches out of the grid, so that a ray in a box is in the grid.
ivec3 first_box(int empty, ivec3 voxel, ivec3 size, bvec3 falling) {
  return min(ivec3(min(empty, kLongestEdge)), mix(size - voxel, voxel + 1, falling));
}

uvec4 first_texel(ivec3 voxel, ivec3 size) {
  int empty = voxel_distance(distance, voxel);
  uvec4 texel = uvec4(0u);
  for (int signs = 0; signs < 8; ++signs) {
    bvec3 falling = bvec3((signs & 1) != 0, (signs & 2) != 0, (signs & 4) != 0);
    texel[box_channel(falling)] |= pack_box(first_box(empty, voxel, size, falling)) << box_shift(falling);
  }
  return texel;
}

// The better of a box and of its first slice together with the box behind that.
ivec3 grown(ivec3 own, ivec3 ahead) {
  if (own == ivec3(0) || ahead == ivec3(0)) return own;
  ivec3 joined = min(own, ahead);
  joined[axis] = min(ahead[axis] + 1, kLongestEdge);
  return box_score(joined) > box_score(own) ? joined : own;
}

// Grows the four boxes of a texel that face one way along the axis; `ahead` is the texel next to it.
uvec4 grown_texel(uvec4 texel, uvec4 ahead, bool falls) {
  for (int signs = 0; signs < 4; ++signs) {
    bool first = (signs & 1) != 0, second = (signs & 2) != 0;
    bvec3 falling = axis == 0 ? bvec3(falls, first, second)
                              : axis == 1 ? bvec3(first, falls, second) : bvec3(first, second, falls);
    ivec3 box = grown(unpack_box(box_ahead(texel, falling)), unpack_box(box_ahead(ahead, falling)));
    uint channel = box_channel(falling);
    texel[channel] = bitfieldInsert(texel[channel], pack_box(box), int(box_shift(falling)), 15);
  }
  return texel;
}

void main() {
  ivec3 size = textureSize(distance, 0);
  ivec2 row = ivec2(gl_GlobalInvocationID.xy);
  ivec3 voxel = axis == 0 ? ivec3(0, row) : axis == 1 ? ivec3(row.x, 0, row.y) : ivec3(row, 0);
  if (any(greaterThanEqual(voxel, size))) return;
  int count = size[axis];
  uvec4 ahead = uvec4(0u);
  for (int k = 2 * count - 1; k >= 0; --k) {
    bool falls = k < count;
    if (k == count - 1) ahead = uvec4(0u);
    voxel[axis] = falls ? count - 1 - k : k - count;
    uvec4 texel = axis == 0 && !falls ? first_texel(voxel, size) : imageLoad(out_boxes, voxel);
    ahead = grown_texel(texel, ahead, falls);
    imageStore(out_boxes, voxel, ahead);
  }
}
