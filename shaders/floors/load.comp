// Reads every texel of an image once for each group along z, kTexels by each invocation, so that what starting an
// invocation costs does not count. Host side: framework/study/device_rates.cpp.
#version 460
#extension GL_EXT_samplerless_texture_functions : require

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const bool unsigned_texels = false;

uniform texture2D texels;
uniform utexture2D unsigned_image;
// Never written, which no compiler can know.
layout(std430) buffer Sink { uint sink; };

const int kTexels = 8;

void main() {
  ivec2 size = unsigned_texels ? textureSize(unsigned_image, 0) : textureSize(texels, 0);
  int rows = size.y / kTexels;
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (texel.x >= size.x || texel.y >= rows) return;
  vec4 sum = vec4(0.0);
  uvec4 bits = uvec4(0u);
  for (int k = 0; k < kTexels; ++k) {
    ivec2 at = ivec2(texel.x, texel.y + k * rows);
    if (unsigned_texels) bits += texelFetch(unsigned_image, at, 0);
    else sum += texelFetch(texels, at, 0);
  }
  if (sum.x + sum.y + sum.z + sum.w == 12345.678 || bits.x + bits.y + bits.z + bits.w == 305419896u) sink = 1u;
}
