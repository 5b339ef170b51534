// The surface's position, moved by a metre along its normal in odd frames.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/scene.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture2D surface_position;
uniform texture2D surface_normal;
uniform writeonly image2D out_position;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, textureSize(surface_position, 0)))) return;
  vec4 position = texelFetch(surface_position, pixel, 0);
  if ((frame.ids.x & 1u) == 1u) position.xyz += texelFetch(surface_normal, pixel, 0).xyz;
  imageStore(out_position, pixel, position);
}
