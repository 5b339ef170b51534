// The G-buffer's values at one pixel; the parts are those of passes/bundles.hpp.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/basis.glsl"
#include "lib/material.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec4 texcoords;
layout(location = 4) in vec4 color;
layout(location = 5) flat in vec3 face_normal;
layout(location = 6) flat in uvec3 ids;
layout(location = 7) flat in uint back;
layout(location = 8) in vec2 weights;

layout(location = 0) out vec4 out_surface_position;
layout(location = 1) out vec4 out_surface_normal;
layout(location = 2) out vec4 out_surface_geometric_normal;
layout(location = 3) out vec4 out_surface_tangent;
layout(location = 4) out vec4 out_surface_albedo;
layout(location = 5) out vec4 out_surface_material;
layout(location = 6) out vec4 out_surface_emission;
layout(location = 7) out uvec4 out_surface_id;

const float kHalfMax = 65504.0;

// Along the view axis [m]; of an orthographic view from the near plane.
float view_depth() {
  if (frame.eye[0].w > 0.5) return 1.0 / gl_FragCoord.w;
  vec4 clip = frame.view_projection[0] * vec4(position, 1.0);
  vec4 near = frame.inverse_view_projection * vec4(clip.xy, 0.0, 1.0);
  return max(distance(position, near.xyz / near.w), 1e-6);
}

// An interpolated or mapped normal can point away from the viewer. Tilts it until it just does not.
vec3 towards_viewer(vec3 n, vec3 to_viewer) {
  const float least = 1e-2;
  float cosine = dot(n, to_viewer);
  return cosine >= least ? n : safe_normalize(n + (least - cosine) * to_viewer, to_viewer);
}

void main() {
  TexturePoint point = TexturePoint(texcoords, dFdx(texcoords), dFdy(texcoords));
  uint id = ids.x;
  MaterialSample m = sample_material(id, point, color);
  if (cut_out(id, m.alpha)) discard;

  // The frame of the front face first; seen from the back, normal and bitangent sign turn together.
  vec3 smooth_normal = safe_normalize(normal, face_normal);
  if (dot(smooth_normal, face_normal) < 0.0) smooth_normal = -smooth_normal;
  float side = back == 1u ? -1.0 : 1.0;
  float handedness = tangent.w < 0.0 ? -1.0 : 1.0;
  vec3 t = orthogonal_tangent(smooth_normal, tangent.xyz);
  vec3 b = cross(smooth_normal, t) * handedness;
  vec3 shading_normal =
      safe_normalize(t * m.normal.x + b * m.normal.y + smooth_normal * m.normal.z, smooth_normal) * side;
  vec3 to_viewer = normalize(frame.eye[0].xyz - position * frame.eye[0].w);
  shading_normal = towards_viewer(shading_normal, to_viewer);
  vec3 lobe = orthogonal_tangent(shading_normal, t * m.direction.x + b * m.direction.y);

  out_surface_position = vec4(position, view_depth());
  out_surface_normal = vec4(shading_normal, 1.0);
  out_surface_geometric_normal = vec4(face_normal * side, materials[id].flags.y != 0u ? 1.0 : 0.0);
  out_surface_tangent = vec4(lobe, handedness * side);
  out_surface_albedo = vec4(m.base_color, m.metallic);
  out_surface_material = vec4(m.ward_alpha, m.f0, m.f90);
  out_surface_emission = vec4(min(m.emission, vec3(kHalfMax)), m.unlit ? 1.0 : 0.0);
  out_surface_id = uvec4(ids.y + 1u, id, ids.z, packUnorm2x16(weights));
}
