// The scene's triangles and their vertices.
#ifndef LIGHTLOOM_LIB_TRIANGLE
#define LIGHTLOOM_LIB_TRIANGLE

#include "lib/corners.glsl"
#include "lib/scene.glsl"

vec3 vertex_position(uint index) { return vertex_at(index).position; }
vec3 vertex_normal(uint index) { return vertex_at(index).normal; }
vec4 vertex_tangent(uint index) { return vertex_at(index).tangent; }
vec4 vertex_texcoords(uint index) { return vertex_at(index).texcoords; }
vec4 vertex_color(uint index) { return vertex_at(index).color; }

Corners world_corners(Triangle t) { return Corners(vertex_position(t.a), vertex_position(t.b), vertex_position(t.c)); }

// Does the viewer see the back of a face with this normal, of any length?
bool seen_from_behind(Corners corners, vec3 face_normal) {
  vec3 to_viewer = frame.eye[0].xyz - corners.a * frame.eye[0].w;
  return dot(face_normal, to_viewer) < 0.0;
}

// By the weights of the corners, which add up to 1: as differences from the first, so that what is the same at all three
// keeps its bits.
vec4 interpolate(vec4 a, vec4 b, vec4 c, vec3 w) { return a + (b - a) * w.y + (c - a) * w.z; }

vec3 interpolate_normal(Triangle t, vec3 w) {
  return interpolate(vec4(vertex_normal(t.a), 0.0), vec4(vertex_normal(t.b), 0.0), vec4(vertex_normal(t.c), 0.0), w).xyz;
}
vec4 interpolate_tangent(Triangle t, vec3 w) {
  vec4 tangent = interpolate(vertex_tangent(t.a), vertex_tangent(t.b), vertex_tangent(t.c), w);
  return vec4(tangent.xyz, vertex_tangent(t.a).w);
}
vec4 interpolate_texcoords(Triangle t, vec3 w) {
  return interpolate(vertex_texcoords(t.a), vertex_texcoords(t.b), vertex_texcoords(t.c), w);
}
vec4 interpolate_color(Triangle t, vec3 w) {
  return interpolate(vertex_color(t.a), vertex_color(t.b), vertex_color(t.c), w);
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
