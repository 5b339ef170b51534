// The empty boxes ahead of a voxel, one for each of the eight signs of a direction, and where they are kept
// (passes/empty_boxes.cpp): four blocks of the grid's size, one for each sign of y and z, so that what a ray reads on
// its way lies side by side.
#ifndef LIGHTLOOM_LIB_EMPTY_BOX
#define LIGHTLOOM_LIB_EMPTY_BOX

const int kLongestEdge = 31;   // [voxels]

// Where the block begins that rays of these signs read.
ivec3 box_block(ivec3 size, bvec3 falling) { return ivec3(0, falling.y ? size.y : 0, falling.z ? size.z : 0); }

// Where in a texel, which has the boxes of both signs of x.
int box_shift(bool falling_x) { return falling_x ? 16 : 0; }

// Edges of 5 bits, x lowest; 0: occupied.
uint pack_box(ivec3 edges) { return uint(edges.x) | (uint(edges.y) << 5u) | (uint(edges.z) << 10u); }
ivec3 unpack_box(uint code) { return ivec3(code & 31u, (code >> 5u) & 31u, (code >> 10u) & 31u); }

uint box_of(uint texel, int shift) { return (texel >> shift) & 0x7fffu; }

#endif
