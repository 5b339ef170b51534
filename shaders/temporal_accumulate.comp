// Weighted mean over the frames that saw the same point. See passes/temporal_accumulate.cpp for the ports and params.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/filter.glsl"
#include "lib/modulation.glsl"
#include "lib/sampling.glsl"
#include "lib/scene.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture2D radiance;
uniform texture2D surface_position;
uniform texture2D surface_normal;
uniform texture2D surface_albedo;
uniform texture2D surface_material;
uniform texture2DArray trail;
uniform texture2DArray trail_position;
uniform texture2DArray trail_normal;
uniform writeonly image2D out_radiance;

layout(push_constant) uniform Params {
  uint frames;
  float position_tolerance;
  float normal_threshold;
  uint trail_count;
  uint trail_first_age;
  uint trail_ring;
  uint trail_newest_layer;
  uint trail_position_ring;
  uint trail_position_newest_layer;
  uint trail_normal_ring;
  uint trail_normal_newest_layer;
};

uint layer_of(uint newest_layer, uint ring, uint age) { return (newest_layer + ring - age) % ring; }

// Did the frame `age` frames ago see this point? If so, `pixel` is where.
bool find_in_frame(uint age, vec3 position, vec3 normal, ivec2 size, out ivec2 pixel) {
  pixel = ivec2(0);
  vec4 clip = frame.view_projection[age] * vec4(position, 1.0);
  if (!(clip.w > 0.0)) return false;
  vec2 place = clip_to_pixel(clip, vec2(size));
  if (!(all(greaterThanEqual(place, vec2(0.0))) && all(lessThan(place, vec2(size))))) return false;
  pixel = min(ivec2(place), size - 1);
  uint position_layer = layer_of(trail_position_newest_layer, trail_position_ring, age);
  vec4 seen = texelFetch(trail_position, ivec3(pixel, position_layer), 0);
  if (!(seen.w > 0.0)) return false;
  uint normal_layer = layer_of(trail_normal_newest_layer, trail_normal_ring, age);
  vec3 seen_normal = texelFetch(trail_normal, ivec3(pixel, normal_layer), 0).xyz;
  if (!(dot(seen_normal, normal) >= normal_threshold)) return false;
  // The nearest pixel's centre lies up to a footprint away on the plane of the surface, more where that is slanted;
  // off the plane it should not lie at all.
  vec3 offset = seen.xyz - position;
  vec3 to_viewer = normalize(frame.eye[age].xyz - position * frame.eye[age].w);
  float tolerance = position_tolerance * pixel_footprint(frame.view_projection[age], clip.w, vec2(size));
  float slant = max(abs(dot(normal, to_viewer)), 0.05);
  return abs(dot(offset, normal)) <= tolerance && dot(offset, offset) <= tolerance * tolerance / (slant * slant);
}

void main() {
  ivec2 size = textureSize(radiance, 0);
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, size))) return;
  vec4 current = texelFetch(radiance, pixel, 0);
  vec4 position = texelFetch(surface_position, pixel, 0);
  if (!(position.w > 0.0)) {
    imageStore(out_radiance, pixel, current);
    return;
  }
  vec3 normal = texelFetch(surface_normal, pixel, 0).xyz;
  vec4 albedo = texelFetch(surface_albedo, pixel, 0);
  vec4 material = texelFetch(surface_material, pixel, 0);
  vec3 to_viewer = normalize(frame.eye[0].xyz - position.xyz * frame.eye[0].w);
  float share = specular_share(Bsdf(albedo.rgb, albedo.w, material.z, material.w, material.xy), dot(normal, to_viewer));
  vec2 roughness = filter_roughness(material.xy, share);

  vec3 sum = current.rgb;
  float weight_sum = 1.0;
  for (uint age = trail_first_age; age < trail_first_age + trail_count && age < frames && age <= frame.ids.z; ++age) {
    float weight = history_weight(float(age), float(frames), max(roughness.x, roughness.y));
    ivec2 earlier;
    if (weight <= 0.0 || !find_in_frame(age, position.xyz, normal, size, earlier)) continue;
    vec4 past = texelFetch(trail, ivec3(earlier, layer_of(trail_newest_layer, trail_ring, age)), 0);
    if (past.a <= 0.0 || !is_finite(past.rgb)) continue;
    sum += weight * past.rgb;
    weight_sum += weight;
  }
  imageStore(out_radiance, pixel, vec4(sum / weight_sum, current.a > 0.0 ? weight_sum : 0.0));
}
