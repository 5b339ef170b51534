#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "lib/scene.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
uniform writeonly image2D out_count;
layout(push_constant) uniform Params { float start; };
void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(out_count)))) return;
  imageStore(out_count, pixel, materials[0].base_color * start);
}
