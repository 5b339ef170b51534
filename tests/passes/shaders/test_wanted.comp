// Two outputs; the second is written where somebody wants it.
#version 460
layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool extra_wanted = true;
uniform writeonly image2D out_main;
uniform writeonly image2D out_extra;
void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(out_main)))) return;
  float value = sqrt(float(1 + pixel.x + 31 * pixel.y));
  imageStore(out_main, pixel, vec4(value, 0.0, 0.0, 0.0));
  if (extra_wanted) imageStore(out_extra, pixel, vec4(2.0 * value, 0.0, 0.0, 0.0));
}
