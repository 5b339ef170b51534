// history = value one frame ago + 1, for tests of rings: after n frames every texel is n.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
layout(local_size_x = 8, local_size_y = 8) in;
uniform texture2D previous;
uniform writeonly image2D out_count;
layout(push_constant) uniform Params { float start; };
void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(out_count)))) return;
  imageStore(out_count, pixel, vec4(texelFetch(previous, pixel, 0).r + 1.0 + start, 0.0, 0.0, 0.0));
}
