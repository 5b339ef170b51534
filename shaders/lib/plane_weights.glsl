// Where a ray meets the plane of a triangle.
#ifndef LIGHTLOOM_LIB_PLANE_WEIGHTS
#define LIGHTLOOM_LIB_PLANE_WEIGHTS

#include "lib/corners.glsl"

// Weights of the corners at the point where the line through `origin` along `direction` meets the plane; they add up to
// 1, and all lie in 0 to 1 within the triangle. Moeller and Trumbore 1997, "Fast, Minimum Storage Ray/Triangle
// Intersection", without its tests. Not finite, or anything, for a line along the plane.
vec3 plane_weights(vec3 origin, vec3 direction, Corners t) {
  vec3 ab = t.b - t.a;
  vec3 ac = t.c - t.a;
  vec3 p = cross(direction, ac);
  vec3 from_a = origin - t.a;
  float volume = dot(ab, p);
  float v = dot(from_a, p) / volume;
  float w = dot(direction, cross(from_a, ab)) / volume;
  return vec3(1.0 - v - w, v, w);
}

// The weights of a point of the triangle that is near a point of its plane: at the point itself within the triangle. For
// what is not finite, the first corner.
vec3 weights_within(vec3 weights) {
  vec3 inside = clamp(weights, vec3(0.0), vec3(1.0));
  float sum = inside.x + inside.y + inside.z;
  return sum >= 0.5 && sum <= 3.0 ? inside / sum : vec3(1.0, 0.0, 0.0);
}

#endif
