// The G-buffer's values at one pixel; the parts are those of passes/bundles.hpp.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/material.glsl"
#include "lib/shading_frame.glsl"
#include "lib/storage.glsl"

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

layout(constant_id = 0) const float out_surface_position_largest = 65504.0;
layout(constant_id = 1) const float out_surface_normal_largest = 65504.0;
layout(constant_id = 2) const float out_surface_geometric_normal_largest = 65504.0;
layout(constant_id = 3) const float out_surface_tangent_largest = 65504.0;
layout(constant_id = 4) const float out_surface_albedo_largest = 65504.0;
layout(constant_id = 5) const float out_surface_material_largest = 65504.0;
layout(constant_id = 6) const float out_surface_emission_largest = 65504.0;

const float kLargestEmission = 3e38;   // an infinity would be NaN wherever it meets a 0

// Along the view axis [m]; of an orthographic view from the near plane.
float view_depth() {
  if (frame.eye[0].w > 0.5) return 1.0 / gl_FragCoord.w;
  vec4 clip = frame.view_projection[0] * vec4(position, 1.0);
  vec4 near = frame.inverse_view_projection * vec4(clip.xy, 0.0, 1.0);
  return max(distance(position, near.xyz / near.w), 1e-6);
}

void main() {
  TexturePoint point = TexturePoint(texcoords, dFdx(texcoords), dFdy(texcoords));
  uint id = ids.x;
  MaterialSample m = sample_material(id, point, color);
  if (cut_out(id, m.alpha)) discard;

  vec3 to_viewer = normalize(frame.eye[0].xyz - position * frame.eye[0].w);
  ShadingFrame shading = shading_frame(face_normal, normal, tangent, m, back == 1u, to_viewer);

  out_surface_position = vec4(position, view_depth());
  out_surface_normal = vec4(shading.normal, 1.0);
  out_surface_geometric_normal = vec4(back == 1u ? -face_normal : face_normal, materials[id].flags.y != 0u ? 1.0 : 0.0);
  out_surface_tangent = vec4(shading.tangent, shading.handedness);
  out_surface_albedo = vec4(m.base_color, m.metallic);
  out_surface_material = vec4(m.ward_alpha, m.f0, m.f90);
  out_surface_emission = vec4(min(m.emission, vec3(kLargestEmission)), m.unlit ? 1.0 : 0.0);
  out_surface_id = uvec4(ids.y + 1u, id, ids.z, packUnorm2x16(weights));

  out_surface_position = storable(out_surface_position, out_surface_position_largest);
  out_surface_normal = storable(out_surface_normal, out_surface_normal_largest);
  out_surface_geometric_normal = storable(out_surface_geometric_normal, out_surface_geometric_normal_largest);
  out_surface_tangent = storable(out_surface_tangent, out_surface_tangent_largest);
  out_surface_albedo = storable(out_surface_albedo, out_surface_albedo_largest);
  out_surface_material = storable(out_surface_material, out_surface_material_largest);
  out_surface_emission = storable(out_surface_emission, out_surface_emission_largest);
}
