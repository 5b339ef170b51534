// Vertices of paths among triangles.
#ifndef LIGHTLOOM_LIB_RAY_VERTEX
#define LIGHTLOOM_LIB_RAY_VERTEX

#include "lib/path_vertex.glsl"
#include "lib/ray_scene.glsl"
#include "lib/shading_frame.glsl"

struct SurfaceHit {
  PathVertex vertex;
  vec3 emission;       // towards where the ray came from [W m^-2 sr^-1]
  uint emission_entry; // of the emission table, by which hints are drawn here; 0: none are
};

// Where rays leave a triangle on the side of the unit normal `side`.
vec3 ray_origin(vec3 position, vec3 side, Corners corners) {
  return position + side * plane_clearance(largest_coordinate(corners));
}

// Puts the first hit, which the G-buffer knows to half precision, onto the plane of its triangle.
void refine_first_hit(inout PathVertex vertex, uint triangle) {
  if (triangle >= frame.counts.x + frame.counts.y) return;
  Corners corners = world_corners(triangle_at(triangle));
  vec3 normal = safe_normalize(area_normal(corners), vertex.geometric_normal);
  if (dot(normal, vertex.geometric_normal) < 0.0) normal = -normal;
  vertex.geometric_normal = normal;
  vec3 on_plane = vertex.position - normal * dot(normal, vertex.position - corners.a);
  vertex.origin = ray_origin(on_plane, normal, corners);
}

// The surface that a ray met, with lobes at least as wide as `least_alpha`. What is unlit shows its colour to the viewer
// alone; here it reflects like anything else.
SurfaceHit surface_hit(RayHit hit, vec3 direction, float least_alpha) {
  Triangle t = triangle_at(hit.triangle);
  vec3 w = corner_weights(hit.weights);
  Corners corners = world_corners(t);
  vec3 face = safe_normalize(area_normal(corners), -direction);
  bool back = dot(face, direction) > 0.0;
  MaterialSample m = sample_material(t.material, texture_point(t, w), interpolate_color(t, w));
  ShadingFrame shading =
      shading_frame(face, interpolate_normal(t, w), interpolate_tangent(t, w), m, back, -direction);

  SurfaceHit result;
  PathVertex vertex;
  vertex.position = corners.a * w.x + corners.b * w.y + corners.c * w.z;
  vertex.geometric_normal = back ? -face : face;
  vertex.origin = ray_origin(vertex.position, vertex.geometric_normal, corners);
  vertex.basis = make_frame(facing_normal(shading.normal, -direction), shading.tangent);
  vertex.incoming = to_local(vertex.basis, -direction);
  vertex.bsdf = Bsdf(m.base_color, m.metallic, m.f0, m.f90, max(m.ward_alpha, vec2(least_alpha)));
  result.vertex = vertex;
  bool emits = !back || materials[t.material].flags.y != 0u;
  result.emission = emits ? m.emission : vec3(0.0);
  result.emission_entry = emits ? emission_index(t.material, m.emission) : 0u;
  return result;
}

#endif
