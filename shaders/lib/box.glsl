// The part of a volume that a dispatch covers: the voxels from low to high, both included (passes/voxel_boxes.hpp).
#ifndef LIGHTLOOM_LIB_BOX
#define LIGHTLOOM_LIB_BOX

layout(push_constant) uniform BoxBlock {
  int box_low_x;
  int box_low_y;
  int box_low_z;
  int box_high_x;
  int box_high_y;
  int box_high_z;
};

ivec3 box_low() { return ivec3(box_low_x, box_low_y, box_low_z); }
ivec3 box_high() { return ivec3(box_high_x, box_high_y, box_high_z); }

// Voxel of this invocation; past `box_high` for the invocations that are too many.
ivec3 box_voxel() { return box_low() + ivec3(gl_GlobalInvocationID); }

bool past_box(ivec3 voxel) { return any(greaterThan(voxel, box_high())); }

#endif
