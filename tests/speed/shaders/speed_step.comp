// One texel, next to no work.
#version 460
#extension GL_EXT_samplerless_texture_functions : require

layout(local_size_x = 1) in;

uniform texture2D x;
uniform writeonly image2D out_a;

layout(push_constant) uniform Params {
  float gain;
};

void main() { imageStore(out_a, ivec2(0), texelFetch(x, ivec2(0), 0) * gain); }
