#version 460
layout(local_size_x = 8, local_size_y = 8) in;
uniform writeonly uimage2D out_ids;
void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  imageStore(out_ids, pixel, uvec4(1u));
}
