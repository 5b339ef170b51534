#version 460
layout(local_size_x = 8, local_size_y = 8) in;
uniform writeonly image2D out_radiance;
void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  imageStore(out_radiance, pixel, vec4(brightness));
}
