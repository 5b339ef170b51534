// Sampling of directions and combination of sampling strategies.
#ifndef LIGHTLOOM_LIB_SAMPLING
#define LIGHTLOOM_LIB_SAMPLING

#include "lib/basis.glsl"
#include "lib/finite.glsl"

// Right-handed basis around a unit normal.
struct LocalFrame {
  vec3 tangent;
  vec3 bitangent;
  vec3 normal;
};

LocalFrame make_frame(vec3 normal, vec3 tangent) {
  vec3 t = orthogonal_tangent(normal, tangent);
  return LocalFrame(t, cross(normal, t), normal);
}

vec3 to_local(LocalFrame basis, vec3 v) {
  return vec3(dot(basis.tangent, v), dot(basis.bitangent, v), dot(basis.normal, v));
}
vec3 to_world(LocalFrame basis, vec3 v) { return basis.tangent * v.x + basis.bitangent * v.y + basis.normal * v.z; }

// Shading normals and coarse voxel normals can face away from the viewer. Tilts such a normal until the cosine is small
// but positive, so that the surface still reflects.
vec3 facing_normal(vec3 normal, vec3 to_viewer) {
  const float least = 0.02;
  float cosine = dot(normal, to_viewer);
  return cosine >= least ? normal : normalize(normal + to_viewer * (least - cosine));
}

// Share of a strategy of density `pdf` beside one of density `other`, one sample of each, by the balance and the power
// heuristic (Veach 1997, section 9.2). Ratios, because squares overflow.
float balance_weight(float pdf, float other) { return pdf > 0.0 ? 1.0 / (1.0 + other / pdf) : 0.0; }
float power_weight(float pdf, float other) {
  float ratio = other / pdf;
  return pdf > 0.0 ? 1.0 / (1.0 + ratio * ratio) : 0.0;
}

// Uniform direction in the cone around `axis` with half angle acos(cosine). 1 - cosine is taken from the caller so that
// small cones keep their precision.
vec3 sample_cone(vec3 axis, float one_minus_cosine, vec2 u) {
  float drop = u.x * one_minus_cosine;
  float radius = sqrt(max(0.0, drop * (2.0 - drop)));
  float phi = 3.14159265358979 * (2.0 * u.y - 1.0);
  LocalFrame around = make_frame(axis, vec3(axis.y, axis.z, axis.x));
  return normalize(to_world(around, vec3(radius * cos(phi), radius * sin(phi), 1.0 - drop)));
}

#endif
