// Light from outside the scene: next event estimation and scattered rays find it together. Who calls looks for what is in
// the way.
#ifndef LIGHTLOOM_LIB_ENVIRONMENT_LIGHT
#define LIGHTLOOM_LIB_ENVIRONMENT_LIGHT

#include "lib/environment.glsl"
#include "lib/mis.glsl"
#include "lib/path_vertex.glsl"

const uint kEnvironmentSamplingOff = 0u;
const uint kEnvironmentSamplingImage = 1u;
layout(constant_id = 30) const uint environment_sampling = 1u;

// Is the environment sampled? Scattered rays find a constant one at least as well, so it is only where nothing else
// may.
bool environment_sampled() {
  return has_environment && kSampleLights && environment_sampling == kEnvironmentSamplingImage &&
         (strategy == kStrategyNee || environment_is_image());
}

LightSample environment_sample(PathVertex vertex, vec4 u) {
  vec3 direction;
  float pdf;
  if (!environment_sampled() || !sample_environment(u, direction, pdf)) return kNoLightSample;
  PerLobe reflected = reflectance_towards(vertex, direction);
  if (is_black(reflected)) return kNoLightSample;
  float weight = light_sample_weight(pdf, scatter_pdf(vertex, direction));
  return LightSample(direction, scaled(reflected, environment_radiance(direction) * weight));
}

// What a scattered ray that leaves the scene adds.
vec3 environment_hit(vec3 direction, BsdfSample scatter) {
  vec3 radiance = environment_radiance(direction);
  if (!environment_sampled()) return radiance;
  return radiance * light_hit_weight(scatter, environment_pdf(direction));
}

#endif
