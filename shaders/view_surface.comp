// Pictures of the G-buffer. See passes/view_surface.cpp for the ports and params.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/color.glsl"
#include "lib/sampling.glsl"
#include "lib/scene.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture2D surface_position;
uniform texture2D surface_normal;
uniform texture2D surface_geometric_normal;
uniform texture2D surface_tangent;
uniform texture2D surface_albedo;
uniform texture2D surface_material;
uniform texture2D surface_emission;
uniform utexture2D surface_id;
uniform texture2D motion;
uniform writeonly image2D out_image;

const uint kShowAlbedo = 0u;
const uint kShowNormal = 1u;
const uint kShowGeometricNormal = 2u;
const uint kShowTangent = 3u;
const uint kShowMaterial = 4u;
const uint kShowEmission = 5u;
const uint kShowObject = 6u;
const uint kShowMaterialId = 7u;
const uint kShowPosition = 8u;
const uint kShowDepth = 9u;
const uint kShowMotion = 10u;
layout(constant_id = 0) const uint show = kShowAlbedo;

const vec3 kNothing = vec3(0.35);
const float kMotionScale = 8.0;   // [pixels]

vec3 direction_color(vec3 direction) { return direction * 0.5 + 0.5; }

vec3 radiance_color(vec3 radiance) {
  if (!is_finite(radiance)) return vec3(1.0, 0.0, 1.0);
  return encode_srgb(clamp(radiance / (1.0 + max(radiance, vec3(0.0))), 0.0, 1.0));
}

vec3 material_color(vec4 material) { return vec3(sqrt(max(material.xy, vec2(0.0))), 4.0 * material.z); }

vec3 position_color(vec3 position) {
  vec3 size = max(frame.scene_max.xyz - frame.scene_min.xyz, vec3(1e-20));
  return (position - frame.scene_min.xyz) / size;
}

vec3 depth_color(float depth) {
  float scale = length(frame.scene_max.xyz - frame.scene_min.xyz) / 8.0;
  return vec3(scale / max(scale + depth, 1e-20));
}

vec3 motion_color(vec2 pixels) { return vec3(pixels / (abs(pixels) + kMotionScale) * 0.5 + 0.5, 0.5); }

vec3 color_of(ivec2 pixel, vec4 position) {
  if (show == kShowNormal) return direction_color(texelFetch(surface_normal, pixel, 0).xyz);
  if (show == kShowGeometricNormal) return direction_color(texelFetch(surface_geometric_normal, pixel, 0).xyz);
  if (show == kShowTangent) return direction_color(texelFetch(surface_tangent, pixel, 0).xyz);
  if (show == kShowMaterial) return material_color(texelFetch(surface_material, pixel, 0));
  if (show == kShowEmission) return radiance_color(texelFetch(surface_emission, pixel, 0).rgb);
  if (show == kShowObject) return id_color(texelFetch(surface_id, pixel, 0).x);
  if (show == kShowMaterialId) return id_color(texelFetch(surface_id, pixel, 0).y + 1u);
  if (show == kShowPosition) return position_color(position.xyz);
  if (show == kShowDepth) return depth_color(position.w);
  if (show == kShowMotion) return motion_color(texelFetch(motion, pixel, 0).xy);
  return encode_srgb(clamp(texelFetch(surface_albedo, pixel, 0).rgb, 0.0, 1.0));
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(out_image)))) return;
  vec4 position = texelFetch(surface_position, pixel, 0);
  imageStore(out_image, pixel, vec4(position.w > 0.0 ? color_of(pixel, position) : kNothing, 1.0));
}
