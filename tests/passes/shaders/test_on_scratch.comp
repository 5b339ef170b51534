// Counts in a scratch image that it takes for zeros, and gives the counts.
#version 460
layout(local_size_x = 8, local_size_y = 8) in;
layout(r32ui) uniform uimage2D count;
layout(r32f) uniform writeonly image2D out_counts;
void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(out_counts)))) return;
  imageStore(out_counts, pixel, vec4(float(imageAtomicAdd(count, pixel, 1u))));
}
