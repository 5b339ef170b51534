// Radiance towards the viewer. See passes/modulate.cpp for the ports and params.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/environment.glsl"
#include "lib/modulation.glsl"
#include "lib/sampling.glsl"
#include "lib/scene.glsl"
#include "lib/storage.glsl"
#include "lib/view_ray.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const bool specular_bound = false;
layout(constant_id = 1) const float out_radiance_largest = 65504.0;

uniform texture2D radiance;
uniform texture2D specular;
uniform texture2D surface_position;
uniform texture2D surface_normal;
uniform texture2D surface_albedo;
uniform texture2D surface_material;
uniform texture2D surface_emission;
uniform writeonly image2D out_radiance;

// `cosine`: between the shading normal and the direction to the viewer, as the tracer takes it.
vec3 reflected_radiance(ivec2 pixel, Bsdf bsdf, float cosine) {
  vec3 first = texelFetch(radiance, pixel, 0).rgb;
  if (!specular_bound) return first * modulation_color(bsdf, cosine);
  vec3 result = first * diffuse_modulation(bsdf, cosine);
  if (has_specular) result += texelFetch(specular, pixel, 0).rgb * specular_modulation(bsdf, cosine);
  return result;
}

vec3 surface_radiance(ivec2 pixel, vec3 position) {
  vec4 emission = texelFetch(surface_emission, pixel, 0);
  vec4 albedo = texelFetch(surface_albedo, pixel, 0);
  if (emission.w > 0.5) return albedo.rgb + emission.rgb;
  vec4 material = texelFetch(surface_material, pixel, 0);
  vec3 to_viewer = normalize(frame.eye[0].xyz - position * frame.eye[0].w);
  vec3 normal = facing_normal(normalize(texelFetch(surface_normal, pixel, 0).xyz), to_viewer);
  Bsdf bsdf = Bsdf(albedo.rgb, albedo.w, material.z, material.w, material.xy);
  return reflected_radiance(pixel, bsdf, dot(normal, to_viewer)) + emission.rgb;
}

void main() {
  ivec2 size = textureSize(surface_position, 0);
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, size))) return;
  vec4 position = texelFetch(surface_position, pixel, 0);
  vec4 result = position.w > 0.0 ? vec4(surface_radiance(pixel, position.xyz), 1.0)
                                 : vec4(environment_radiance(view_ray(pixel, size).direction), 0.0);
  imageStore(out_radiance, pixel, storable(result, out_radiance_largest));
}
