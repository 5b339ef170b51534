// The first vertex of a path: the surface that the G-buffer holds in a pixel.
#ifndef LIGHTLOOM_LIB_FIRST_HIT
#define LIGHTLOOM_LIB_FIRST_HIT

#include "lib/path_vertex.glsl"
#include "lib/scene.glsl"

uniform texture2D surface_position;
uniform texture2D surface_normal;
uniform texture2D surface_geometric_normal;
uniform texture2D surface_tangent;
uniform texture2D surface_albedo;
uniform texture2D surface_material;
uniform texture2D surface_emission;

// Is there a surface that light is traced for? Unlit ones show what they show.
bool is_lit(ivec2 pixel) {
  return texelFetch(surface_position, pixel, 0).w > 0.0 && texelFetch(surface_emission, pixel, 0).w < 0.5;
}

// The vertex of a lit pixel; `origin` is left to the caller.
PathVertex first_hit(ivec2 pixel) {
  PathVertex vertex;
  vec3 position = texelFetch(surface_position, pixel, 0).xyz;
  vec4 albedo = texelFetch(surface_albedo, pixel, 0);
  vec4 material = texelFetch(surface_material, pixel, 0);
  vec3 to_viewer = normalize(frame.eye[0].xyz - position * frame.eye[0].w);
  vertex.position = position;
  vertex.origin = position;
  vertex.geometric_normal = normalize(texelFetch(surface_geometric_normal, pixel, 0).xyz);
  vec3 normal = facing_normal(normalize(texelFetch(surface_normal, pixel, 0).xyz), to_viewer);
  vertex.basis = make_frame(normal, texelFetch(surface_tangent, pixel, 0).xyz);
  vertex.incoming = to_local(vertex.basis, to_viewer);
  vertex.bsdf = Bsdf(albedo.rgb, albedo.w, material.z, material.w, material.xy);
  return vertex;
}

#endif
