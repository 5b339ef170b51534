// The ray through a pixel's centre.
#ifndef LIGHTLOOM_LIB_VIEW_RAY
#define LIGHTLOOM_LIB_VIEW_RAY

#include "lib/scene.glsl"

struct ViewRay {
  vec3 origin;      // the viewer; for an orthographic camera a point of the near plane [m]
  vec3 direction;   // unit
};

// A perspective ray is where the planes of its pixel's column and row meet. That keeps the precision of the matrix; its
// inverse, with a near plane far nearer than the far one, has lost a thousandth of a radian.
ViewRay view_ray(ivec2 pixel, ivec2 size) {
  vec2 ndc = (vec2(pixel) + 0.5) / vec2(size) * 2.0 - 1.0;
  if (frame.eye[0].w < 0.5) {
    vec4 point = frame.inverse_view_projection * vec4(ndc, 0.0, 1.0);
    return ViewRay(point.xyz / point.w, -frame.eye[0].xyz);
  }
  mat4 rows = transpose(frame.view_projection[0]);
  vec3 along = cross(rows[0].xyz - ndc.x * rows[3].xyz, rows[1].xyz - ndc.y * rows[3].xyz);
  return ViewRay(frame.eye[0].xyz, normalize(dot(along, rows[3].xyz) < 0.0 ? -along : along));
}

#endif
