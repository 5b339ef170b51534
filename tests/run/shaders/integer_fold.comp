#version 460
#extension GL_GOOGLE_include_directive : require
#include "integer.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
uniform utexture3D v;
uniform writeonly uimage2D out_a;
layout(push_constant) uniform Params { uint salt; };
void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(out_a)))) return;
  ivec3 size = textureSize(v, 0);
  uint hash = salt;
  for (int z = 0; z < size.z; ++z) hash = mixed(hash, texelFetch(v, ivec3(pixel % size.xy, z), 0).r);
  imageStore(out_a, pixel, uvec4(hash));
}
