// What the spatial filters share: how far they reach from a pixel, and which neighbours belong to it.
#ifndef LIGHTLOOM_LIB_NEIGHBOUR
#define LIGHTLOOM_LIB_NEIGHBOUR

#include "lib/color.glsl"
#include "lib/filter.glsl"
#include "lib/modulation.glsl"
#include "lib/sampling.glsl"
#include "lib/scene.glsl"

layout(constant_id = 0) const uint lobe = 0u;     // kLobeBoth, ...
layout(constant_id = 1) const uint kernel = 0u;   // 0: anisotropic, 1: isotropic
layout(constant_id = 2) const uint roughness = 0u;   // 0: alpha, 1: perceptual
layout(constant_id = 3) const bool variance_bound = false;

uniform texture2D radiance;
uniform texture2D surface_position;
uniform texture2D surface_normal;
uniform texture2D surface_tangent;
uniform texture2D surface_albedo;
uniform texture2D surface_material;
uniform utexture2D surface_id;
uniform texture2D variance;

// Push constants by the names of the params in passes/spatial_filter.cpp.
struct FilterShape {
  float floor_fraction;
  float distance_fraction;
  float normal_threshold;
  float variance_guide;
  float full_width_error;
  float difference_limit;
};

// The pixel that is being filtered.
struct Centre {
  ivec2 pixel;
  vec4 radiance;
  vec4 position;    // [m]; w: view depth
  vec3 normal;
  vec3 tangent;
  vec3 bitangent;
  uint object;
  vec2 reach;       // half lengths along tangent and bitangent [m]
  float kept;       // part of its length that a filter keeps, 0 to 1
  float variance;   // of the luminance
  FilterShape shape;
};

float scene_diagonal() { return length(frame.scene_max.xyz - frame.scene_min.xyz); }

vec2 kernel_roughness(Centre centre) {
  vec4 albedo = texelFetch(surface_albedo, centre.pixel, 0);
  vec4 material = texelFetch(surface_material, centre.pixel, 0);
  vec3 to_viewer = normalize(frame.eye[0].xyz - centre.position.xyz * frame.eye[0].w);
  Bsdf bsdf = Bsdf(albedo.rgb, albedo.w, material.z, material.w, material.xy);
  float share = lobe == kLobeBoth ? specular_share(bsdf, dot(centre.normal, to_viewer)) : 1.0;
  vec2 measure = lobe_roughness(lobe, material.xy, share);
  if (roughness == 1u) measure = sqrt(measure);
  return kernel == 0u ? measure : vec2(sqrt(measure.x * measure.y));
}

// Part of the length to keep, from the relative standard error of a pixel's radiance. Mean and variance are themselves
// estimates of few samples, and both are small where by chance no light was found; so they are taken over the 3x3 pixels
// around, as far as they show the same object.
float kept_length(Centre centre, FilterShape shape) {
  if (!variance_bound || shape.variance_guide <= 0.0) return 1.0;
  ivec2 last = textureSize(radiance, 0) - 1;
  vec3 sum = vec3(0.0);   // luminance, its variance, pixels
  for (int k = 0; k < 9; ++k) {
    ivec2 pixel = clamp(centre.pixel + ivec2(k % 3, k / 3) - 1, ivec2(0), last);
    if (texelFetch(surface_id, pixel, 0).x != centre.object) continue;
    vec4 value = texelFetch(radiance, pixel, 0);
    vec3 moments = vec3(luminance(value.rgb), texelFetch(variance, pixel, 0).x, 1.0);
    if (value.a > 0.0 && is_finite(moments)) sum += max(moments, vec3(0.0));
  }
  // Nothing found, nothing known.
  if (!(sum.x > 0.0)) return 1.0;
  float error = sqrt(sum.y * sum.z) / sum.x;
  return mix(1.0, guided_length(error, shape.full_width_error), shape.variance_guide);
}

// False where there is nothing to filter: background, unlit.
bool load_centre(ivec2 pixel, FilterShape shape, out Centre centre) {
  centre.pixel = pixel;
  centre.radiance = texelFetch(radiance, pixel, 0);
  centre.position = texelFetch(surface_position, pixel, 0);
  if (!(centre.position.w > 0.0 && centre.radiance.a > 0.0)) return false;
  centre.normal = texelFetch(surface_normal, pixel, 0).xyz;
  centre.tangent = texelFetch(surface_tangent, pixel, 0).xyz;
  centre.bitangent = cross(centre.normal, centre.tangent);
  centre.object = texelFetch(surface_id, pixel, 0).x;
  float length = filter_reach(shape.floor_fraction * scene_diagonal(), shape.distance_fraction, centre.position.w);
  centre.reach = length * kernel_roughness(centre);
  centre.kept = kept_length(centre, shape);
  centre.variance = variance_bound ? texelFetch(variance, pixel, 0).x : 0.0;
  centre.shape = shape;
  return true;
}

// Where fewer than so many frames stand behind a pixel, the variance is estimated from the 25 pixels around it
// (temporal_accumulate): a single bright one among them is sqrt(24) of their standard deviations above the rest.
const float kHistoryOfOwn = 4.0;
const float kNeighbourhoodLimit = 5.0;

// May chance explain the difference between the two? Both variances count, so that what is improbably bright is spread
// as well as blurred: pixels that share a test share their light, and the mean stays.
bool may_be_equal(Centre centre, ivec2 pixel, vec4 value) {
  float limit = centre.shape.difference_limit;
  if (!variance_bound || limit <= 0.0) return true;
  if (min(value.a, centre.radiance.a) < kHistoryOfOwn) limit = max(limit, kNeighbourhoodLimit);
  float difference = luminance(value.rgb) - luminance(centre.radiance.rgb);
  return !(difference * difference > limit * limit * (centre.variance + texelFetch(variance, pixel, 0).x));
}

// Adds a neighbour if it shows the same object, faces alike, lies within the radial cut-off and, as far as the variance
// tells, may have the same light.
void add_neighbour(Centre centre, ivec2 pixel, inout vec4 sum) {
  if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, textureSize(radiance, 0)))) return;
  if (texelFetch(surface_id, pixel, 0).x != centre.object) return;
  vec3 offset = texelFetch(surface_position, pixel, 0).xyz - centre.position.xyz;
  float cutoff = max(centre.reach.x, centre.reach.y);
  if (!(dot(offset, offset) <= cutoff * cutoff)) return;
  if (!(dot(texelFetch(surface_normal, pixel, 0).xyz, centre.normal) >= centre.shape.normal_threshold)) return;
  vec4 value = texelFetch(radiance, pixel, 0);
  if (value.a <= 0.0 || !is_finite(value.rgb) || !may_be_equal(centre, pixel, value)) return;
  sum += vec4(value.rgb, 1.0);
}

#endif
