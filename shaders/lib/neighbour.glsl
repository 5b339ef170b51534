// What the spatial filters share: how far they reach from a pixel, and which neighbours belong to it.
#ifndef LIGHTLOOM_LIB_NEIGHBOUR
#define LIGHTLOOM_LIB_NEIGHBOUR

#include "lib/filter.glsl"
#include "lib/filter_guide.glsl"
#include "lib/modulation.glsl"
#include "lib/relative_error.glsl"
#include "lib/scene.glsl"

layout(constant_id = 0) const uint lobe = 0u;     // kLobeBoth, ...
layout(constant_id = 1) const uint kernel = 0u;   // 0: anisotropic, 1: isotropic
layout(constant_id = 2) const uint roughness = 0u;   // 0: alpha, 1: perceptual
layout(constant_id = 3) const bool variance_bound = false;
layout(constant_id = 4) const bool guide_bound = false;

uniform texture2D surface_position;
uniform texture2D surface_normal;
uniform texture2D surface_tangent;
uniform texture2D surface_albedo;
uniform texture2D surface_material;
uniform utexture2D guide;

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
  Guide guide;      // of the pixel itself
  vec2 reach;       // half lengths along tangent and bitangent [m]
  float kept;       // part of its length that a filter keeps, 0 to 1
  FilterShape shape;
};

const bool knows_variance = variance_bound || guide_bound;

// What tells whether a pixel belongs to the centre. Unpacked, positions are not from the viewer; only differences count.
Guide load_guide(ivec2 pixel) {
  if (guide_bound) return unpack_guide(texelFetch(guide, pixel, 0));
  SurfacePoint point = SurfacePoint(texelFetch(surface_normal, pixel, 0).xyz, texelFetch(surface_position, pixel, 0).xyz);
  return Guide(texelFetch(surface_id, pixel, 0).x, point, variance_bound ? texelFetch(variance, pixel, 0).x : 0.0, 0.0);
}

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

// Part of the length to keep.
float kept_length(Centre centre, FilterShape shape) {
  if (!knows_variance || shape.variance_guide <= 0.0) return 1.0;
  float error = guide_bound ? centre.guide.error : relative_error(centre.pixel, centre.guide.object);
  return mix(1.0, guided_length(error, shape.full_width_error), shape.variance_guide);
}

// False where there is nothing to filter: background, unlit. The centre is then one of no reach.
bool load_centre(ivec2 pixel, FilterShape shape, out Centre centre) {
  centre.pixel = pixel;
  centre.radiance = texelFetch(radiance, pixel, 0);
  centre.position = texelFetch(surface_position, pixel, 0);
  centre.normal = texelFetch(surface_normal, pixel, 0).xyz;
  centre.tangent = texelFetch(surface_tangent, pixel, 0).xyz;
  centre.bitangent = cross(centre.normal, centre.tangent);
  centre.guide = load_guide(pixel);
  float length = filter_reach(shape.floor_fraction * scene_diagonal(), shape.distance_fraction, centre.position.w);
  centre.reach = length * kernel_roughness(centre);
  centre.kept = kept_length(centre, shape);
  centre.shape = shape;
  bool filtered = centre.position.w > 0.0 && centre.radiance.a > 0.0;
  if (!filtered) {
    centre.reach = vec2(0.0);
    centre.kept = 0.0;
  }
  return filtered;
}

// Where fewer than so many frames stand behind a pixel, the variance is estimated from the 25 pixels around it
// (temporal_accumulate): a single bright one among them is sqrt(24) of their standard deviations above the rest.
const float kHistoryOfOwn = 4.0;
const float kNeighbourhoodLimit = 5.0;

// May chance explain the difference between the two? Both variances count, so that what is improbably bright is spread
// as well as blurred: pixels that share a test share their light, and the mean stays.
bool may_be_equal(Centre centre, float variance, vec4 value) {
  float limit = centre.shape.difference_limit;
  bool tested = knows_variance && limit > 0.0;
  limit = min(value.a, centre.radiance.a) < kHistoryOfOwn ? max(limit, kNeighbourhoodLimit) : limit;
  float difference = luminance(value.rgb) - luminance(centre.radiance.rgb);
  return !(tested && difference * difference > limit * limit * (centre.guide.variance + variance));
}

vec3 offset_from(Centre centre, Guide other) { return other.point.position - centre.guide.point.position; }

// Does a neighbour show the same object, face alike, lie within the radial cut-off and, as far as the variance tells,
// may it have the same light?
bool belongs(Centre centre, Guide other, vec4 value) {
  vec3 offset = offset_from(centre, other);
  float cutoff = max(centre.reach.x, centre.reach.y);
  bool alike = all(bvec3(other.object == centre.guide.object, dot(offset, offset) <= cutoff * cutoff,
                         dot(other.point.normal, centre.normal) >= centre.shape.normal_threshold));
  return all(bvec4(alike, value.a > 0.0, is_finite(value.rgb), may_be_equal(centre, other.variance, value)));
}

// A pixel that may be added. What lies outside of the image is loaded from its rim and does not count. There are no
// branches, for a processor that computes several pixels at once goes all ways anyway.
struct Neighbour {
  Guide guide;
  vec4 radiance;
  bool counts;
};

Neighbour load_neighbour(Centre centre, ivec2 pixel) {
  ivec2 inside = clamp(pixel, ivec2(0), textureSize(radiance, 0) - 1);
  Guide other = load_guide(inside);
  vec4 value = texelFetch(radiance, inside, 0);
  return Neighbour(other, value, inside == pixel ? belongs(centre, other, value) : false);
}

void add_neighbour(Neighbour neighbour, inout vec4 sum) {
  sum += neighbour.counts ? vec4(neighbour.radiance.rgb, 1.0) : vec4(0.0);
}

#endif
