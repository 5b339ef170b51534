// Weighted mean over the frames that saw the same point, and how noisy it still is. Whoever includes this declares the push
// constants `frames`, `position_tolerance`, `normal_threshold` and those of the range `trail`, and says what earlier frames
// saw.
#ifndef LIGHTLOOM_LIB_TEMPORAL
#define LIGHTLOOM_LIB_TEMPORAL

#include "lib/filter.glsl"
#include "lib/modulation.glsl"
#include "lib/reprojection.glsl"
#include "lib/sampling.glsl"
#include "lib/scene.glsl"
#include "lib/storage.glsl"
#include "lib/variance.glsl"

layout(constant_id = 0) const uint lobe = 0u;
layout(constant_id = 2) const bool variance_wanted = true;
layout(constant_id = 3) const float out_radiance_largest = 65504.0;
layout(constant_id = 4) const float out_variance_largest = 65504.0;

uniform texture2D radiance;
uniform texture2D surface_position;
uniform texture2D surface_normal;
uniform texture2D surface_albedo;
uniform texture2D surface_material;
uniform utexture2D surface_id;
uniform texture2DArray trail;
uniform writeonly image2D out_radiance;
uniform writeonly image2D out_variance;

// With fewer frames than these, the noise is estimated from the neighbours instead.
const float kLeastFrames = 4.0;
const int kNeighbourRadius = 2;

uint layer_of(uint newest_layer, uint ring, uint age) { return (newest_layer + ring - age) % ring; }

// Variance of a single frame's luminance at a pixel, from the pixels around it that show the same surface.
float neighbourhood_variance(ivec2 pixel, Point point, ivec2 size) {
  float clip_w = (frame.view_projection[0] * vec4(point.position, 1.0)).w;
  float tolerance = position_tolerance * pixel_footprint(frame.view_projection[0], clip_w, vec2(size));
  ivec2 low = max(pixel - kNeighbourRadius, ivec2(0));
  ivec2 high = min(pixel + kNeighbourRadius, size - 1);
  Moments moments = kNoMoments;
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      ivec2 other = ivec2(x, y);
      vec4 value = texelFetch(radiance, other, 0);
      if (value.a <= 0.0 || !is_finite(value.rgb)) continue;
      if (!same_material(texelFetch(surface_id, other, 0), point.id)) continue;
      if (!(dot(texelFetch(surface_normal, other, 0).xyz, point.normal) >= normal_threshold)) continue;
      vec3 offset = texelFetch(surface_position, other, 0).xyz - point.position;
      if (!(abs(dot(offset, point.normal)) <= tolerance)) continue;
      add_sample(moments, luminance(value.rgb), 1.0);
    }
  }
  return sample_variance(moments);
}

// A frame with a NaN or an infinity is left out, the current one too.
void add_frame(vec3 value, float weight, inout vec3 sum, inout Moments moments) {
  if (!is_finite(value)) return;
  sum += weight * value;
  add_sample(moments, luminance(value), weight);
}

float history_roughness(ivec2 pixel, Point point) {
  vec4 albedo = texelFetch(surface_albedo, pixel, 0);
  vec4 material = texelFetch(surface_material, pixel, 0);
  vec3 to_viewer = normalize(frame.eye[0].xyz - point.position * frame.eye[0].w);
  Bsdf bsdf = Bsdf(albedo.rgb, albedo.w, material.z, material.w, material.xy);
  vec2 roughness = lobe_roughness(lobe, material.xy, specular_share(bsdf, dot(point.normal, to_viewer)));
  return max(roughness.x, roughness.y);
}

void accumulate() {
  ivec2 size = textureSize(radiance, 0);
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, size))) return;
  vec4 current = texelFetch(radiance, pixel, 0);
  vec4 position = texelFetch(surface_position, pixel, 0);
  if (!(position.w > 0.0 && current.a > 0.0)) {
    imageStore(out_radiance, pixel, storable(vec4(current.rgb, 0.0), out_radiance_largest));
    if (variance_wanted) imageStore(out_variance, pixel, vec4(0.0));
    return;
  }
  Point point = Point(position.xyz, texelFetch(surface_normal, pixel, 0).xyz, texelFetch(surface_id, pixel, 0));
  float roughness = history_roughness(pixel, point);

  vec3 sum = vec3(0.0);
  Moments moments = kNoMoments;
  add_frame(current.rgb, 1.0, sum, moments);
  for (uint age = trail_first_age; age < trail_first_age + trail_count && age < frames && age <= frame.ids.z; ++age) {
    float weight = history_weight(float(age), float(frames), roughness);
    ivec2 earlier;
    if (weight <= 0.0 || !find_in_frame(age, past_point(point, age), size, earlier)) continue;
    vec4 past = texelFetch(trail, ivec3(earlier, layer_of(trail_newest_layer, trail_ring, age)), 0);
    if (past.a > 0.0) add_frame(past.rgb, weight, sum, moments);
  }
  imageStore(out_radiance, pixel, storable(vec4(sum / max(moments.weight, 1e-30), moments.weight), out_radiance_largest));
  if (!variance_wanted) return;
  float variance = effective_count(moments) < kLeastFrames ? neighbourhood_variance(pixel, point, size)
                                                           : sample_variance(moments);
  variance = mean_variance(moments, variance);
  imageStore(out_variance, pixel, storable(vec4(is_finite(variance) ? variance : kUnknownVariance), out_variance_largest));
}

#endif
