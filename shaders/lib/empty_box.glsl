// The empty boxes ahead of a voxel, one for each of the eight signs of a direction, and how a texel holds them
// (passes/empty_boxes.cpp).
#ifndef LIGHTLOOM_LIB_EMPTY_BOX
#define LIGHTLOOM_LIB_EMPTY_BOX

const int kLongestEdge = 31;   // [voxels]

// Channel: +y +z, -y +z, +y -z, -y -z. Low half: +x, high half: -x. In each 5 bits an edge, x lowest; 0: occupied.
uint box_channel(bvec3 falling) { return (falling.y ? 1u : 0u) + (falling.z ? 2u : 0u); }
uint box_shift(bvec3 falling) { return falling.x ? 16u : 0u; }

uint pack_box(ivec3 edges) { return uint(edges.x) | (uint(edges.y) << 5u) | (uint(edges.z) << 10u); }
ivec3 unpack_box(uint code) { return ivec3(code & 31u, (code >> 5u) & 31u, (code >> 10u) & 31u); }

// The box of a texel for directions of these signs, packed.
uint box_ahead(uvec4 texel, bvec3 falling) {
  uint channel = falling.z ? (falling.y ? texel.a : texel.b) : (falling.y ? texel.g : texel.r);
  return (channel >> box_shift(falling)) & 0x7fffu;
}

#endif
