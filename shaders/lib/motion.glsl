// Where what a pixel of the G-buffer shows was in earlier frames.
#ifndef LIGHTLOOM_LIB_MOTION
#define LIGHTLOOM_LIB_MOTION

#include "lib/basis.glsl"
#include "lib/features.glsl"
#include "lib/triangle.glsl"

// Does the surface with this `surface.id` move or deform?
bool is_dynamic(uvec4 id) { return has_dynamic && id.x != 0u && id.z >= frame.counts.x; }

// Corners `age` frames ago; beyond what is kept, those of the oldest frame.
Corners past_corners(Triangle t, uint age) {
  uint slot = (frame.motion.z + kHistoryLimit - min(age, frame.motion.w - 1u)) % kHistoryLimit;
  uint base = slot * frame.motion.y - frame.motion.x;
  return Corners(past_positions[base + t.a].xyz, past_positions[base + t.b].xyz, past_positions[base + t.c].xyz);
}

// Where the surface point with `surface.id` and `surface.position` [m] was `age` frames ago: exact for rigid, skinned
// and morphed objects alike, because points keep their place on their triangle. What is added is how far the corners
// have moved since, so that the id's rounding of the weights counts by the motion's change over the triangle alone.
vec3 past_position(uvec4 id, vec3 position, uint age) {
  if (!is_dynamic(id)) return position;
  Triangle t = triangle_at(id.z);
  Corners now = past_corners(t, 0u);
  Corners then = past_corners(t, age);
  vec2 w = unpackUnorm2x16(id.w);
  return position + (1.0 - w.x - w.y) * (then.a - now.a) + w.x * (then.b - now.b) + w.y * (then.c - now.c);
}

// Right-handed frame of the triangle: edge ab, across it, normal. All 0 for a triangle without area.
mat3 face_frame(Corners t) {
  vec3 ab = t.b - t.a;
  vec3 x = safe_normalize(ab, vec3(0.0));
  vec3 z = safe_normalize(area_normal(t), vec3(0.0));
  return mat3(x, cross(z, x), z);
}

// The same for `surface.normal`: turned as the triangle was. 0 where the triangle had no area, so that nothing could be
// seen of it.
vec3 past_normal(uvec4 id, vec3 normal, uint age) {
  if (!is_dynamic(id)) return normal;
  Triangle t = triangle_at(id.z);
  return face_frame(past_corners(t, age)) * (normal * face_frame(past_corners(t, 0u)));
}

#endif
