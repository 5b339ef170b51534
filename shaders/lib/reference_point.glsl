// What packed positions are taken from.
#ifndef LIGHTLOOM_LIB_REFERENCE_POINT
#define LIGHTLOOM_LIB_REFERENCE_POINT

#include "lib/basis.glsl"
#include "lib/packed_point.glsl"
#include "lib/scene.glsl"

// In the frame `age` frames ago the viewer, who is close to what has to be told apart, or for an orthographic camera, which
// is nowhere, the middle of the scene.
vec3 reference_point(uint age) {
  return frame.eye[age].w > 0.5 ? frame.eye[age].xyz : 0.5 * (frame.scene_min.xyz + frame.scene_max.xyz);
}

// A point of this frame's G-buffer as it is packed.
SurfacePoint point_to_pack(vec3 position, vec3 normal) {
  return SurfacePoint(safe_normalize(normal, vec3(0.0, 0.0, 1.0)), position - reference_point(0u));
}

#endif
