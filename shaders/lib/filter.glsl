// What the temporal and spatial filters share: how wide, how long, and which pixels belong together.
#ifndef LIGHTLOOM_LIB_FILTER
#define LIGHTLOOM_LIB_FILTER

// Roughness along the tangent and bitangent as the filters see it. What a Lambertian surface reflects looks the same
// from everywhere, so it counts as 1. `share` is the specular part of the reflectance; its fourth power, because of a
// surface that does both the base's noise is seen long before the reflection's edges are.
vec2 filter_roughness(vec2 alpha, float share) {
  float share2 = share * share;
  return mix(vec2(1.0), clamp(alpha, vec2(0.0), vec2(1.0)), share2 * share2);
}

// Which part of the reflected light a filter is given: values of the param `lobe`.
const uint kLobeBoth = 0u;
const uint kLobeDiffuse = 1u;
const uint kLobeSpecular = 2u;

// The same for a filter that may be given one lobe alone: the base's light counts as 1, that of the lobe by its alpha.
vec2 lobe_roughness(uint lobe, vec2 alpha, float share) {
  if (lobe == kLobeDiffuse) return vec2(1.0);
  return filter_roughness(alpha, lobe == kLobeSpecular ? 1.0 : share);
}

// Weight of a frame `age` frames ago (paper, section 2.3): a Hermite curve over the age, stretched by the roughness.
// 1 for all ages at roughness 1, 0 for all but the current frame at roughness 0, and in between it falls to 0 at age
// frames * roughness / (1 - roughness).
float history_weight(float age, float frames, float roughness) {
  if (age <= 0.0) return 1.0;
  float x = clamp(1.0 - age / frames * (1.0 - roughness) / max(roughness, 1e-6), 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

// Half length of the spatial filters at roughness 1 [m].
float filter_reach(float floor_length, float distance_fraction, float view_depth) {
  return max(floor_length, distance_fraction * view_depth);
}

// How much of its length a filter keeps where the mean is known to a relative standard error `error`: full from
// `full_width_error` on, going to 0 with the error, without a kink at either end of the range that matters: x (2 - x).
// The number of pixels that a filter of two such passes averages falls with the square of the length, so that at small
// errors the error after the filter is about the same everywhere.
float guided_length(float error, float full_width_error) {
  float x = clamp(error / full_width_error, 0.0, 1.0);
  return x * (2.0 - x);
}

// Position in pixels (pixel (i, j) covers [i, i+1) x [j, j+1)) of a point in clip space.
vec2 clip_to_pixel(vec4 clip, vec2 size) { return (clip.xy / clip.w * 0.5 + 0.5) * size; }

// Width of a pixel, as seen head on at a point with clip coordinate w [m].
float pixel_footprint(mat4 view_projection, float clip_w, vec2 size) {
  vec3 x = vec3(view_projection[0].x, view_projection[1].x, view_projection[2].x);
  vec3 y = vec3(view_projection[0].y, view_projection[1].y, view_projection[2].y);
  return 2.0 * clip_w * max(1.0 / (length(x) * size.x), 1.0 / (length(y) * size.y));
}

#endif
