// One axis of the chessboard distance: d'(p) = min over |k| <= radius of max(|k|, d(p + k axis)). Run along x, y and z
// it is exact up to the radius. It gathers, so nothing races and nothing needs an atomic.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/box.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture3D voxels_albedo;
layout(r8) uniform image3D along_x;
layout(r8) uniform image3D along_xy;
uniform writeonly image3D out_distance;

layout(constant_id = 0) const int axis = 0;
layout(constant_id = 1) const int radius = 4;

int previous_distance(ivec3 voxel) {
  if (axis == 0) return texelFetch(voxels_albedo, voxel, 0).a > 0.5 ? 0 : radius + 1;
  float texel = axis == 1 ? imageLoad(along_x, voxel).r : imageLoad(along_xy, voxel).r;
  return int(texel * 255.0 + 0.5);
}

void main() {
  ivec3 voxel = box_voxel();
  if (past_box(voxel)) return;
  ivec3 extent = imageSize(out_distance);
  int nearest = previous_distance(voxel);
  // From the inside out: a step further than what is already found cannot improve it.
  for (int k = 1; k < nearest; ++k) {
    ivec3 before = voxel;
    ivec3 after = voxel;
    before[axis] -= k;
    after[axis] += k;
    if (before[axis] >= 0) nearest = min(nearest, max(k, previous_distance(before)));
    if (after[axis] < extent[axis]) nearest = min(nearest, max(k, previous_distance(after)));
  }
  vec4 texel = vec4(float(nearest) / 255.0);
  if (axis == 0) imageStore(along_x, voxel, texel);
  else if (axis == 1) imageStore(along_xy, voxel, texel);
  else imageStore(out_distance, voxel, texel);
}
