// Light of known strength, as the tracer would hand it to the filters.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/modulation.glsl"
#include "lib/sampling.glsl"
#include "lib/scene.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture2D surface_position;
uniform texture2D surface_normal;
uniform texture2D surface_albedo;
uniform texture2D surface_material;
uniform writeonly image2D out_radiance;
uniform writeonly image2D out_diffuse;
uniform writeonly image2D out_specular;
uniform writeonly image2D out_light;

layout(push_constant) uniform Params {
  float diffuse;
  float specular;
};

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, textureSize(surface_position, 0)))) return;
  vec4 position = texelFetch(surface_position, pixel, 0);
  vec4 albedo = texelFetch(surface_albedo, pixel, 0);
  vec4 material = texelFetch(surface_material, pixel, 0);
  vec3 to_viewer = normalize(frame.eye[0].xyz - position.xyz * frame.eye[0].w);
  vec3 normal = facing_normal(normalize(texelFetch(surface_normal, pixel, 0).xyz), to_viewer);
  float cosine = dot(normal, to_viewer);
  Bsdf bsdf = Bsdf(albedo.rgb, albedo.w, material.z, material.w, material.xy);
  vec3 by_base = diffuse * diffuse_albedo(bsdf, cosine);
  vec3 by_lobe = has_specular ? specular * specular_fresnel(bsdf, cosine) : vec3(0.0);
  float lit = position.w > 0.0 ? 1.0 : 0.0;
  imageStore(out_light, pixel, vec4(by_base + by_lobe, lit));
  imageStore(out_radiance, pixel, vec4((by_base + by_lobe) / modulation_color(bsdf, cosine), lit));
  imageStore(out_diffuse, pixel, vec4(by_base / diffuse_modulation(bsdf, cosine), lit));
  imageStore(out_specular, pixel, vec4(by_lobe / specular_modulation(bsdf, cosine), lit));
}
