// Reads a history range: texel x holds the value that was x + P_first_age frames ago.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
layout(local_size_x = 8, local_size_y = 8) in;
uniform texture2DArray trail;
uniform writeonly image2D out_ages;
layout(push_constant) uniform Params {
  uint trail_count;
  uint trail_first_age;
  uint trail_ring;
  uint trail_newest_layer;
};
void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(out_ages)))) return;
  uint age = trail_first_age + min(uint(pixel.x), trail_count - 1u);
  uint layer = (trail_newest_layer + trail_ring - age) % trail_ring;
  imageStore(out_ages, pixel, vec4(texelFetch(trail, ivec3(pixel, layer), 0).r, 0.0, 0.0, 0.0));
}
