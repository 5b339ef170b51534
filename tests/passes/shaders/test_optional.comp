// 1 where the optional input is bound, and its value; 0 otherwise.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool guide_bound = false;
uniform texture2D guide;
uniform writeonly image2D out_seen;
void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(out_seen)))) return;
  float value = guide_bound ? 1.0 + texelFetch(guide, pixel, 0).r : 0.0;
  imageStore(out_seen, pixel, vec4(value, 0.0, 0.0, 0.0));
}
