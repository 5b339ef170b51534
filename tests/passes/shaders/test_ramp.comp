// The same in every frame.
#version 460
layout(local_size_x = 8, local_size_y = 8) in;
uniform writeonly image2D out_ramp;
void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (all(lessThan(pixel, imageSize(out_ramp)))) imageStore(out_ramp, pixel, vec4(float(1 + pixel.x), 0.0, 0.0, 0.0));
}
