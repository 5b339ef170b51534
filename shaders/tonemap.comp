// Linear radiance to display values. See passes/tonemap.cpp for the ports and params.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/color.glsl"
#include "lib/sampling.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture2D radiance;
uniform writeonly image2D out_image;

layout(push_constant) uniform Params {
  float exposure;   // [EV]
  uint curve;       // 0: filmic, 1: reinhard, 2: linear
};

// K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2016.
vec3 filmic(vec3 x) { return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14); }

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, textureSize(radiance, 0)))) return;
  vec3 color = texelFetch(radiance, pixel, 0).rgb;
  if (!is_finite(color)) color = vec3(0.0);
  // Beyond 1e9 every curve is flat, and the squares of the rational ones would overflow.
  color = clamp(color * exp2(exposure), vec3(0.0), vec3(1e9));
  if (curve == 0u) color = filmic(color);
  if (curve == 1u) color = color / (1.0 + color);
  imageStore(out_image, pixel, vec4(encode_srgb(clamp(color, vec3(0.0), vec3(1.0))), 1.0));
}
