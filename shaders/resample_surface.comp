// The G-buffer at another size: the texel under each new pixel's centre.
#version 460
#extension GL_EXT_samplerless_texture_functions : require

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

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  uvec2 size = uvec2(imageSize(out_surface_position));
  if (any(greaterThanEqual(pixel, size))) return;
  // floor((pixel + 1/2) * from / size), in integers: exact for every ratio.
  uvec2 from = uvec2(textureSize(surface_position, 0));
  ivec2 source = ivec2(((2u * pixel + 1u) * from) / (2u * size));
  ivec2 target = ivec2(pixel);
  imageStore(out_surface_position, target, texelFetch(surface_position, source, 0));
  imageStore(out_surface_normal, target, texelFetch(surface_normal, source, 0));
  imageStore(out_surface_geometric_normal, target, texelFetch(surface_geometric_normal, source, 0));
  imageStore(out_surface_tangent, target, texelFetch(surface_tangent, source, 0));
  imageStore(out_surface_albedo, target, texelFetch(surface_albedo, source, 0));
  imageStore(out_surface_material, target, texelFetch(surface_material, source, 0));
  imageStore(out_surface_emission, target, texelFetch(surface_emission, source, 0));
  imageStore(out_surface_id, target, texelFetch(surface_id, source, 0));
}
