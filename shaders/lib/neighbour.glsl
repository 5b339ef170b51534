// Rejection tests of the spatial filters. Needs `radiance` and the parts of `surface` as textures.
#ifndef LIGHTLOOM_LIB_NEIGHBOUR
#define LIGHTLOOM_LIB_NEIGHBOUR

#include "lib/filter.glsl"
#include "lib/modulation.glsl"
#include "lib/sampling.glsl"
#include "lib/scene.glsl"

uniform texture2D radiance;
uniform texture2D surface_position;
uniform texture2D surface_normal;
uniform texture2D surface_albedo;
uniform texture2D surface_material;
uniform utexture2D surface_id;

// The pixel that is being filtered.
struct Centre {
  ivec2 pixel;
  vec4 radiance;
  vec4 position;    // [m]; w: view depth
  vec3 normal;
  uint object;
  vec2 roughness;   // along the tangent and the bitangent
  float reach;      // half length at roughness 1 [m]
};

// False where there is nothing to filter: background, unlit.
bool load_centre(ivec2 pixel, float floor_length, float distance_fraction, out Centre centre) {
  centre.pixel = pixel;
  centre.radiance = texelFetch(radiance, pixel, 0);
  centre.position = texelFetch(surface_position, pixel, 0);
  centre.normal = texelFetch(surface_normal, pixel, 0).xyz;
  centre.object = texelFetch(surface_id, pixel, 0).x;
  vec4 albedo = texelFetch(surface_albedo, pixel, 0);
  vec4 material = texelFetch(surface_material, pixel, 0);
  vec3 to_viewer = normalize(frame.eye[0].xyz - centre.position.xyz * frame.eye[0].w);
  Bsdf bsdf = Bsdf(albedo.rgb, albedo.w, material.z, material.w, material.xy);
  centre.roughness = filter_roughness(material.xy, specular_share(bsdf, dot(centre.normal, to_viewer)));
  centre.reach = filter_reach(floor_length, distance_fraction, centre.position.w);
  return centre.position.w > 0.0 && centre.radiance.a > 0.0;
}

float scene_diagonal() { return length(frame.scene_max.xyz - frame.scene_min.xyz); }

// Adds a neighbour if it shows the same object, faces alike and lies within the radial cut-off.
void add_neighbour(Centre centre, ivec2 pixel, float normal_threshold, inout vec4 sum) {
  if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, textureSize(radiance, 0)))) return;
  if (texelFetch(surface_id, pixel, 0).x != centre.object) return;
  vec3 offset = texelFetch(surface_position, pixel, 0).xyz - centre.position.xyz;
  float cutoff = centre.reach * max(centre.roughness.x, centre.roughness.y);
  if (!(dot(offset, offset) <= cutoff * cutoff)) return;
  if (!(dot(texelFetch(surface_normal, pixel, 0).xyz, centre.normal) >= normal_threshold)) return;
  vec4 value = texelFetch(radiance, pixel, 0);
  if (value.a <= 0.0 || !is_finite(value.rgb)) return;
  sum += vec4(value.rgb, 1.0);
}

#endif
