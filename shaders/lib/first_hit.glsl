// The first vertex of a path: the surface that the G-buffer holds in a pixel.
#ifndef LIGHTLOOM_LIB_FIRST_HIT
#define LIGHTLOOM_LIB_FIRST_HIT

#include "lib/scene.glsl"
#include "lib/surface_texels.glsl"

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
  SurfaceTexels texels;
  texels.position = texelFetch(surface_position, pixel, 0);
  texels.normal = texelFetch(surface_normal, pixel, 0);
  texels.geometric_normal = texelFetch(surface_geometric_normal, pixel, 0);
  texels.tangent = texelFetch(surface_tangent, pixel, 0);
  texels.albedo = texelFetch(surface_albedo, pixel, 0);
  texels.material = texelFetch(surface_material, pixel, 0);
  return vertex_of_surface(texels, frame.eye[0]);
}

#endif
