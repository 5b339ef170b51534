#version 460
layout(local_size_x = 8, local_size_y = 8) in;
uniform texture2D radiance;
shared float sum;
void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  sum = texelFetch(radiance, pixel, 0).x;
}
