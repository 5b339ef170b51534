// One box of voxels into one row. See passes/moved_voxels.cpp.
#version 460

layout(local_size_x = 1) in;

layout(push_constant) uniform Params {
  int box_low_x;
  int box_low_y;
  int box_low_z;
  int box_high_x;
  int box_high_y;
  int box_high_z;
  int row;
};

uniform writeonly uimage2D out_moved;

void main() {
  imageStore(out_moved, ivec2(0, row), uvec4(box_low_x, box_low_y, box_low_z, 0));
  imageStore(out_moved, ivec2(1, row), uvec4(ivec3(box_high_x, box_high_y, box_high_z) + 1, 0));
}
