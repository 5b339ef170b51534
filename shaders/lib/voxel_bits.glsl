// How wide the normals of the voxels are that a pass reads as its input `voxels`.
#ifndef LIGHTLOOM_LIB_VOXEL_BITS
#define LIGHTLOOM_LIB_VOXEL_BITS

layout(constant_id = 31) const uint voxels_normal_bits = 8u;

#endif
