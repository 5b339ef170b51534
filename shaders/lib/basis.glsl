// Orthonormal frames.
#ifndef LIGHTLOOM_LIB_BASIS
#define LIGHTLOOM_LIB_BASIS

#include "lib/finite.glsl"

// Two unit vectors that form a right-handed frame (x, y, normal) with a unit normal. No direction is singular.
// Duff et al. 2017, "Building an Orthonormal Basis, Revisited", JCGT 6(1).
void orthonormal_basis(vec3 normal, out vec3 x, out vec3 y) {
  float side = normal.z >= 0.0 ? 1.0 : -1.0;
  float a = -1.0 / (side + normal.z);
  float b = normal.x * normal.y * a;
  x = vec3(1.0 + side * normal.x * normal.x * a, side * b, -side * normal.x);
  y = vec3(b, side + normal.y * normal.y * a, -normal.y);
}

// Normalised, or `otherwise` where the length is 0 or not finite.
vec3 safe_normalize(vec3 v, vec3 otherwise) {
  float size = max(abs(v.x), max(abs(v.y), abs(v.z)));
  // A largest of several may leave out those that are NaN.
  if (!is_finite(v) || !(size > 1e-30 && size < 1e30)) return otherwise;
  return normalize(v / size);
}

// The part of `tangent` that is orthogonal to the unit normal, as a unit vector; any such vector where there is none.
vec3 orthogonal_tangent(vec3 normal, vec3 tangent) {
  vec3 x, y;
  orthonormal_basis(normal, x, y);
  tangent = safe_normalize(tangent, x);
  vec3 across = tangent - normal * dot(normal, tangent);
  if (dot(across, across) < 1e-8) return x;
  return normalize(across);
}

#endif
