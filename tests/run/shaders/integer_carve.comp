#version 460
#extension GL_GOOGLE_include_directive : require
#include "integer.glsl"
layout(local_size_x = 4, local_size_y = 4, local_size_z = 2) in;
uniform utexture3D v;
uniform utexture3D old;
uniform writeonly uimage3D out_v;
layout(push_constant) uniform Params { uint salt; };
void main() {
  ivec3 voxel = ivec3(gl_GlobalInvocationID);
  if (any(greaterThanEqual(voxel, imageSize(out_v)))) return;
  imageStore(out_v, voxel, uvec4(mixed(mixed(salt, texelFetch(v, voxel, 0).r), texelFetch(old, voxel, 0).r)));
}
