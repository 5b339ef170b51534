// Normal and tangent that a triangle's surface is shaded with, on the side of who looks at it.
#ifndef LIGHTLOOM_LIB_SHADING_FRAME
#define LIGHTLOOM_LIB_SHADING_FRAME

#include "lib/basis.glsl"
#include "lib/material.glsl"

struct ShadingFrame {
  vec3 normal;        // unit, on the viewer's side
  vec3 tangent;       // unit, orthogonal to it: the direction of Ward alpha x
  float handedness;   // of the bitangent
};

// An interpolated or mapped normal can point away from the viewer. Tilts it until it just does not.
vec3 towards_viewer(vec3 n, vec3 to_viewer) {
  const float least = 1e-2;
  float cosine = dot(n, to_viewer);
  return cosine >= least ? n : safe_normalize(n + (least - cosine) * to_viewer, to_viewer);
}

// `face_normal`: unit, of the front; `normal` and `tangent`: interpolated; `back`: the viewer sees the back.
ShadingFrame shading_frame(vec3 face_normal, vec3 normal, vec4 tangent, MaterialSample m, bool back, vec3 to_viewer) {
  // The frame of the front face first; seen from the back, normal and bitangent sign turn together.
  vec3 smooth_normal = safe_normalize(normal, face_normal);
  if (dot(smooth_normal, face_normal) < 0.0) smooth_normal = -smooth_normal;
  float side = back ? -1.0 : 1.0;
  float handedness = tangent.w < 0.0 ? -1.0 : 1.0;
  vec3 t = orthogonal_tangent(smooth_normal, tangent.xyz);
  vec3 b = cross(smooth_normal, t) * handedness;
  vec3 shading_normal =
      safe_normalize(t * m.normal.x + b * m.normal.y + smooth_normal * m.normal.z, smooth_normal) * side;
  shading_normal = towards_viewer(shading_normal, to_viewer);
  vec3 lobe = orthogonal_tangent(shading_normal, t * m.direction.x + b * m.direction.y);
  return ShadingFrame(shading_normal, lobe, handedness * side);
}

#endif
