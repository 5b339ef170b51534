// The sun: a direction, or a disc that next event estimation and scattered rays find together. Who calls looks for what
// is in the way.
#ifndef LIGHTLOOM_LIB_SUN
#define LIGHTLOOM_LIB_SUN

#include "lib/mis.glsl"
#include "lib/path_vertex.glsl"
#include "lib/scene.glsl"

const uint kSunDelta = 0u;
const uint kSunDisc = 1u;
layout(constant_id = 22) const uint sun = 1u;

// 1 - cosine of the angular radius; 0 for a sun without extent.
float sun_drop() { return sun == kSunDisc ? frame.sun_irradiance.w : 0.0; }

// Density of directions drawn on the disc [sr^-1].
float sun_pdf(float drop) { return 1.0 / (6.28318530717959 * drop); }

// The irradiance on a surface that faces the sun is radiance times pi sin^2 of the angular radius.
vec3 sun_radiance(float drop) { return frame.sun_irradiance.rgb / (3.14159265358979 * drop * (2.0 - drop)); }

LightSample sun_sample(PathVertex vertex, vec2 u) {
  if (!has_sun) return kNoLightSample;
  float drop = sun_drop();
  if (drop > 0.0 && !kSampleLights) return kNoLightSample;
  vec3 direction = -frame.sun_direction.xyz;
  if (drop > 0.0) direction = sample_cone(direction, drop, u);
  PerLobe reflected = reflectance_towards(vertex, direction);
  if (is_black(reflected)) return kNoLightSample;
  if (drop <= 0.0) return LightSample(direction, scaled(reflected, frame.sun_irradiance.rgb));
  float weight = light_sample_weight(sun_pdf(drop), scatter_pdf(vertex, direction));
  return LightSample(direction, scaled(reflected, sun_radiance(drop) * weight));
}

// Share of the sun's disc that a scattered ray which leaves the scene adds. The distance between unit vectors keeps its
// digits where a cosine near 1 has lost them.
vec3 sun_hit(vec3 direction, BsdfSample scatter) {
  float drop = sun_drop();
  vec3 off_centre = direction + frame.sun_direction.xyz;
  if (!has_sun || drop <= 0.0 || 0.5 * dot(off_centre, off_centre) > drop) return vec3(0.0);
  return sun_radiance(drop) * light_hit_weight(scatter, sun_pdf(drop));
}

#endif
