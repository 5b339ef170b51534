#version 460
layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba16f) uniform image2D radiance;
uniform writeonly image2D out_radiance;
void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  imageStore(radiance, pixel, vec4(0.0));
  imageStore(out_radiance, pixel, vec4(0.0));
}
