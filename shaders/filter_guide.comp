// What the spatial filters ask of each pixel, packed. See passes/filter_guide.cpp for the ports.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/filter_guide.glsl"
#include "lib/reference_point.glsl"
#include "lib/relative_error.glsl"
#include "lib/variance.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const bool variance_bound = false;
layout(constant_id = 1) const bool radiance_bound = false;

uniform texture2D surface_position;
uniform texture2D surface_normal;
uniform writeonly uimage2D out_guide;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, textureSize(surface_position, 0)))) return;
  vec4 position = texelFetch(surface_position, pixel, 0);
  Guide guide;
  guide.object = texelFetch(surface_id, pixel, 0).x;
  guide.point = point_to_pack(position.xyz, texelFetch(surface_normal, pixel, 0).xyz);
  guide.variance = variance_bound ? min(texelFetch(variance, pixel, 0).x, kUnknownVariance) : kUnknownVariance;
  guide.error = variance_bound && radiance_bound ? relative_error(pixel, guide.object) : kUnknownError;
  bool seen = position.w > 0.0 && is_finite(position.xyz);
  imageStore(out_guide, pixel, seen ? pack_guide(guide) : uvec4(0));
}
