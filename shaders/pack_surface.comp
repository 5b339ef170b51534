// What histories ask of each pixel, packed. See passes/pack_surface.cpp for the ports.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 8, local_size_y = 8) in;

#include "lib/packed_surface.glsl"
#include "lib/reference_point.glsl"
#include "lib/sampling.glsl"

uniform texture2D surface_position;
uniform texture2D surface_normal;
uniform utexture2D surface_id;
uniform writeonly uimage2D out_point;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, textureSize(surface_position, 0)))) return;
  vec4 position = texelFetch(surface_position, pixel, 0);
  uvec4 id = texelFetch(surface_id, pixel, 0);
  vec3 normal = texelFetch(surface_normal, pixel, 0).xyz;
  PackedSurface surface = PackedSurface(id.x, id.y, point_to_pack(position.xyz, normal));
  bool seen = position.w > 0.0 && is_finite(position.xyz);
  imageStore(out_point, pixel, seen ? pack_surface(surface) : uvec4(0));
}
