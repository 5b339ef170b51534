// The G-buffer at another size: the texel under each new pixel's centre.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/storage.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture2D surface_position;
uniform texture2D surface_normal;
uniform texture2D surface_geometric_normal;
uniform texture2D surface_tangent;
uniform texture2D surface_albedo;
uniform texture2D surface_material;
uniform texture2D surface_emission;
uniform utexture2D surface_id;
uniform writeonly image2D out_surface_position;
uniform writeonly image2D out_surface_normal;
uniform writeonly image2D out_surface_geometric_normal;
uniform writeonly image2D out_surface_tangent;
uniform writeonly image2D out_surface_albedo;
uniform writeonly image2D out_surface_material;
uniform writeonly image2D out_surface_emission;
uniform writeonly uimage2D out_surface_id;

layout(constant_id = 0) const float out_surface_position_largest = 65504.0;
layout(constant_id = 1) const float out_surface_normal_largest = 65504.0;
layout(constant_id = 2) const float out_surface_geometric_normal_largest = 65504.0;
layout(constant_id = 3) const float out_surface_tangent_largest = 65504.0;
layout(constant_id = 4) const float out_surface_albedo_largest = 65504.0;
layout(constant_id = 5) const float out_surface_material_largest = 65504.0;
layout(constant_id = 6) const float out_surface_emission_largest = 65504.0;

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  uvec2 size = uvec2(imageSize(out_surface_position));
  if (any(greaterThanEqual(pixel, size))) return;
  // floor((pixel + 1/2) * from / size), in integers: exact for every ratio.
  uvec2 from = uvec2(textureSize(surface_position, 0));
  ivec2 source = ivec2(((2u * pixel + 1u) * from) / (2u * size));
  ivec2 target = ivec2(pixel);
  imageStore(out_surface_position, target, storable(texelFetch(surface_position, source, 0), out_surface_position_largest));
  imageStore(out_surface_normal, target, storable(texelFetch(surface_normal, source, 0), out_surface_normal_largest));
  imageStore(out_surface_geometric_normal, target, storable(texelFetch(surface_geometric_normal, source, 0), out_surface_geometric_normal_largest));
  imageStore(out_surface_tangent, target, storable(texelFetch(surface_tangent, source, 0), out_surface_tangent_largest));
  imageStore(out_surface_albedo, target, storable(texelFetch(surface_albedo, source, 0), out_surface_albedo_largest));
  imageStore(out_surface_material, target, storable(texelFetch(surface_material, source, 0), out_surface_material_largest));
  imageStore(out_surface_emission, target, storable(texelFetch(surface_emission, source, 0), out_surface_emission_largest));
  imageStore(out_surface_id, target, texelFetch(surface_id, source, 0));
}
