// The scene's triangles and their vertices.
#ifndef LIGHTLOOM_LIB_TRIANGLE
#define LIGHTLOOM_LIB_TRIANGLE

#include "lib/basis.glsl"
#include "lib/scene.glsl"

// Corners; in which units, the user says.
struct Corners {
  vec3 a;
  vec3 b;
  vec3 c;
};

vec3 vertex_position(uint index) { return vec3(vertices[index].px, vertices[index].py, vertices[index].pz); }
vec3 vertex_normal(uint index) { return vec3(vertices[index].nx, vertices[index].ny, vertices[index].nz); }
vec4 vertex_tangent(uint index) {
  return vec4(vertices[index].tx, vertices[index].ty, vertices[index].tz, vertices[index].tw);
}
vec4 vertex_texcoords(uint index) {
  return vec4(vertices[index].u0, vertices[index].v0, vertices[index].u1, vertices[index].v1);
}
vec4 vertex_color(uint index) { return unpackUnorm4x8(vertices[index].color); }

Corners world_corners(Triangle t) { return Corners(vertex_position(t.a), vertex_position(t.b), vertex_position(t.c)); }

// Twice the area, along the normal of the front face (counter-clockwise corners).
vec3 area_normal(Corners t) { return cross(t.b - t.a, t.c - t.a); }

// Barycentric coordinates of the triangle's point nearest to `p`. Ericson 2005, "Real-Time Collision Detection", 5.1.5:
// the Voronoi region of p (corner, edge or face) is found from dot products alone. A triangle without area gives a point
// of it, never NaN.
vec3 nearest_barycentric(vec3 p, Corners t) {
  vec3 ab = t.b - t.a;
  vec3 ac = t.c - t.a;
  vec3 ap = p - t.a;
  float ap_ab = dot(ab, ap);
  float ap_ac = dot(ac, ap);
  if (ap_ab <= 0.0 && ap_ac <= 0.0) return vec3(1.0, 0.0, 0.0);
  vec3 bp = p - t.b;
  float bp_ab = dot(ab, bp);
  float bp_ac = dot(ac, bp);
  if (bp_ab >= 0.0 && bp_ac <= bp_ab) return vec3(0.0, 1.0, 0.0);
  vec3 cp = p - t.c;
  float cp_ab = dot(ab, cp);
  float cp_ac = dot(ac, cp);
  if (cp_ac >= 0.0 && cp_ab <= cp_ac) return vec3(0.0, 0.0, 1.0);
  float area_c = ap_ab * bp_ac - bp_ab * ap_ac;
  if (area_c <= 0.0 && ap_ab >= 0.0 && bp_ab <= 0.0) {
    float v = ap_ab / max(ap_ab - bp_ab, 1e-30);
    return vec3(1.0 - v, v, 0.0);
  }
  float area_b = cp_ab * ap_ac - ap_ab * cp_ac;
  if (area_b <= 0.0 && ap_ac >= 0.0 && cp_ac <= 0.0) {
    float w = ap_ac / max(ap_ac - cp_ac, 1e-30);
    return vec3(1.0 - w, 0.0, w);
  }
  float area_a = bp_ab * cp_ac - cp_ab * bp_ac;
  float towards_c = bp_ac - bp_ab;
  float towards_b = cp_ab - cp_ac;
  if (area_a <= 0.0 && towards_c >= 0.0 && towards_b >= 0.0) {
    float w = towards_c / max(towards_c + towards_b, 1e-30);
    return vec3(0.0, 1.0 - w, w);
  }
  float total = area_a + area_b + area_c;
  if (!(total > 0.0)) return vec3(1.0, 0.0, 0.0);
  return vec3(area_a, area_b, area_c) / total;
}

vec3 interpolate_normal(Triangle t, vec3 w) {
  return vertex_normal(t.a) * w.x + vertex_normal(t.b) * w.y + vertex_normal(t.c) * w.z;
}
vec4 interpolate_tangent(Triangle t, vec3 w) {
  vec3 direction = vertex_tangent(t.a).xyz * w.x + vertex_tangent(t.b).xyz * w.y + vertex_tangent(t.c).xyz * w.z;
  return vec4(direction, vertex_tangent(t.a).w);
}
vec4 interpolate_texcoords(Triangle t, vec3 w) {
  return vertex_texcoords(t.a) * w.x + vertex_texcoords(t.b) * w.y + vertex_texcoords(t.c) * w.z;
}
vec4 interpolate_color(Triangle t, vec3 w) {
  return vertex_color(t.a) * w.x + vertex_color(t.b) * w.y + vertex_color(t.c) * w.z;
}

// Change of the texture coordinates over one unit of length along the edge ab, and across it within the triangle.
void texcoord_gradients(Triangle t, Corners corners, out vec4 along, out vec4 across) {
  vec3 ab = corners.b - corners.a;
  vec3 ac = corners.c - corners.a;
  vec4 uv = vertex_texcoords(t.a);
  vec4 uv_ab = vertex_texcoords(t.b) - uv;
  vec4 uv_ac = vertex_texcoords(t.c) - uv;
  float squared = max(dot(ab, ab), 1e-30);
  float height = length(cross(ab, ac)) * inversesqrt(squared);
  along = uv_ab * inversesqrt(squared);
  across = (uv_ac - uv_ab * (dot(ab, ac) / squared)) / max(height, 1e-15);
}

#endif
