// Writes every texel of an image once for each group along z, kTexels by each invocation. Host side:
// framework/study/device_rates.cpp.
#version 460

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const bool unsigned_texels = false;

uniform writeonly image2D texels;
uniform writeonly uimage2D unsigned_image;

const int kTexels = 8;

void main() {
  ivec2 size = unsigned_texels ? imageSize(unsigned_image) : imageSize(texels);
  int rows = size.y / kTexels;
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (texel.x >= size.x || texel.y >= rows) return;
  for (int k = 0; k < kTexels; ++k) {
    ivec2 at = ivec2(texel.x, texel.y + k * rows);
    if (unsigned_texels) imageStore(unsigned_image, at, uvec4(at, k, 0));
    else imageStore(texels, at, vec4(0.25, 0.5, 0.75, 1.0));
  }
}
