// The G-buffer's values at each pixel, of the triangle that it shows; the parts are those of passes/bundles.hpp.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/plane_weights.glsl"
#include "lib/sampling.glsl"
#include "lib/shading_frame.glsl"
#include "lib/storage.glsl"
#include "lib/triangle.glsl"
#include "lib/view_ray.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform utexture2D visibility;   // of the draws before
uniform writeonly image2D out_surface_position;
uniform writeonly image2D out_surface_normal;
uniform writeonly image2D out_surface_geometric_normal;
uniform writeonly image2D out_surface_tangent;
uniform writeonly image2D out_surface_albedo;
uniform writeonly image2D out_surface_material;
uniform writeonly image2D out_surface_emission;
uniform writeonly uimage2D out_surface_id;

layout(constant_id = 0) const float out_surface_position_largest = 65504.0;
layout(constant_id = 1) const float out_surface_normal_largest = 65504.0;
layout(constant_id = 2) const float out_surface_geometric_normal_largest = 65504.0;
layout(constant_id = 3) const float out_surface_tangent_largest = 65504.0;
layout(constant_id = 4) const float out_surface_albedo_largest = 65504.0;
layout(constant_id = 5) const float out_surface_material_largest = 65504.0;
layout(constant_id = 6) const float out_surface_emission_largest = 65504.0;

const float kLargestEmission = 3e38;   // an infinity would be NaN wherever it meets a 0
const float kLargestGradient = 1e6;    // of texture coordinates over a pixel; at the horizon of a plane they have no bound

// What a pixel shows.
struct Surface {
  vec4 position;
  vec4 normal;
  vec4 geometric_normal;
  vec4 tangent;
  vec4 albedo;
  vec4 material;
  vec4 emission;
  uvec4 id;
};

// Along the view axis [m]; of an orthographic view from the near plane.
float view_depth(vec3 position, ViewRay ray) {
  if (frame.eye[0].w > 0.5) return max((frame.view_projection[0] * vec4(position, 1.0)).w, 1e-30);
  return max(distance(position, ray.origin), 1e-6);
}

vec3 weights_along(ivec2 pixel, ivec2 size, Corners corners) {
  ViewRay ray = view_ray(pixel, size);
  return plane_weights(ray.origin, ray.direction, corners);
}

// Change of the texture coordinates from one point of the triangle's plane to another.
vec4 texcoord_change(Triangle t, vec3 from, vec3 to) {
  vec4 change = interpolate_texcoords(t, to) - interpolate_texcoords(t, from);
  if (!is_finite(change.xyz) || !is_finite(change.w)) return vec4(kLargestGradient);
  return clamp(change, vec4(-kLargestGradient), vec4(kLargestGradient));
}

Surface surface_at(ivec2 pixel, ivec2 size, uint index) {
  Triangle t = triangle_at(index);
  Corners corners = world_corners(t);
  ViewRay ray = view_ray(pixel, size);
  vec3 on_plane = plane_weights(ray.origin, ray.direction, corners);
  vec3 weights = weights_within(on_plane);
  vec3 position = corners.a + (corners.b - corners.a) * weights.y + (corners.c - corners.a) * weights.z;

  TexturePoint point;
  point.uv = interpolate_texcoords(t, weights);
  point.dx = texcoord_change(t, on_plane, weights_along(pixel + ivec2(1, 0), size, corners));
  point.dy = texcoord_change(t, on_plane, weights_along(pixel + ivec2(0, 1), size, corners));
  MaterialSample m = sample_material(t.material, point, interpolate_color(t, weights));

  vec3 to_viewer = normalize(frame.eye[0].xyz - position * frame.eye[0].w);
  vec3 face_normal = safe_normalize(area_normal(corners), vec3(0.0, 1.0, 0.0));
  bool back = seen_from_behind(corners, face_normal);
  vec4 tangent = interpolate_tangent(t, weights);
  ShadingFrame shading = shading_frame(face_normal, interpolate_normal(t, weights), tangent, m, back, to_viewer);

  Surface surface;
  surface.position = vec4(position, view_depth(position, ray));
  surface.normal = vec4(shading.normal, 1.0);
  surface.geometric_normal = vec4(back ? -face_normal : face_normal, materials[t.material].flags.y != 0u ? 1.0 : 0.0);
  surface.tangent = vec4(shading.tangent, shading.handedness);
  surface.albedo = vec4(m.base_color, m.metallic);
  surface.material = vec4(m.ward_alpha, m.f0, m.f90);
  surface.emission = vec4(min(m.emission, vec3(kLargestEmission)), m.unlit ? 1.0 : 0.0);
  surface.id = uvec4(t.object + 1u, t.material, index, packUnorm2x16(weights.yz));
  return surface;
}

void main() {
  ivec2 size = textureSize(visibility, 0);
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, size))) return;
  uint triangle = texelFetch(visibility, pixel, 0).x;
  Surface surface = Surface(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), uvec4(0));
  if (triangle > 0u) surface = surface_at(pixel, size, triangle - 1u);
  imageStore(out_surface_position, pixel, storable(surface.position, out_surface_position_largest));
  imageStore(out_surface_normal, pixel, storable(surface.normal, out_surface_normal_largest));
  imageStore(out_surface_geometric_normal, pixel, storable(surface.geometric_normal, out_surface_geometric_normal_largest));
  imageStore(out_surface_tangent, pixel, storable(surface.tangent, out_surface_tangent_largest));
  imageStore(out_surface_albedo, pixel, storable(surface.albedo, out_surface_albedo_largest));
  imageStore(out_surface_material, pixel, storable(surface.material, out_surface_material_largest));
  imageStore(out_surface_emission, pixel, storable(surface.emission, out_surface_emission_largest));
  imageStore(out_surface_id, pixel, surface.id);
}
