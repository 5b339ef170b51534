// A vertex of a path from what a G-buffer holds in a pixel.
#ifndef LIGHTLOOM_LIB_SURFACE_TEXELS
#define LIGHTLOOM_LIB_SURFACE_TEXELS

#include "lib/path_vertex.glsl"

// As in passes/bundles.hpp.
struct SurfaceTexels {
  vec4 position;
  vec4 normal;
  vec4 geometric_normal;
  vec4 tangent;
  vec4 albedo;
  vec4 material;
};

// `eye`: frame.eye of the frame that the G-buffer is of. `origin` is left to the caller.
PathVertex vertex_of_surface(SurfaceTexels texels, vec4 eye) {
  PathVertex vertex;
  vec3 position = texels.position.xyz;
  vec3 to_viewer = normalize(eye.xyz - position * eye.w);
  vertex.position = position;
  vertex.origin = position;
  vertex.geometric_normal = normalize(texels.geometric_normal.xyz);
  vec3 normal = facing_normal(normalize(texels.normal.xyz), to_viewer);
  vertex.basis = make_frame(normal, texels.tangent.xyz);
  vertex.incoming = to_local(vertex.basis, to_viewer);
  vertex.bsdf = Bsdf(texels.albedo.rgb, texels.albedo.w, texels.material.z, texels.material.w, texels.material.xy);
  return vertex;
}

#endif
