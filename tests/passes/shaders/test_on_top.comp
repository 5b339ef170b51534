// Adds to what stands in its output, or (clamped) takes it for no less than 0.
#version 460
layout(local_size_x = 8, local_size_y = 8) in;
layout(r32f) uniform image2D out_sum;
layout(push_constant) uniform Params { bool clamped; };
void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(out_sum)))) return;
  float before = imageLoad(out_sum, pixel).r;
  imageStore(out_sum, pixel, vec4(clamped ? max(before, 0.0) : before + 1.0));
}
