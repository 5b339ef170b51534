// Vertices of the G-buffer's draws by vertex pulling.
#ifndef LIGHTLOOM_LIB_GATHER_VERTEX
#define LIGHTLOOM_LIB_GATHER_VERTEX

#include "lib/corners.glsl"
#include "lib/triangle.glsl"

// A corner that its two companions share leaves no pixels.
const vec4 kNowhere = vec4(0.0, 0.0, 2.0, 1.0);

uint corner_vertex(Triangle t, uint corner) { return corner == 0u ? t.a : corner == 1u ? t.b : t.c; }

// Where a corner is in clip space. Nowhere if the viewer sees the back of a single-sided material, and if there is no
// area: all three corners come to the same answer.
vec4 clip_position(Triangle t, uint corner) {
  Corners corners = world_corners(t);
  bool hidden = materials[t.material].flags.y == 0u && seen_from_behind(corners, area_normal(corners));
  vec3 position = corner == 0u ? corners.a : corner == 1u ? corners.b : corners.c;
  vec4 clip = frame.view_projection[0] * vec4(position, 1.0);
  return hidden || !has_area(corners) ? kNowhere : clip;
}

#endif
