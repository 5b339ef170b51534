// The colour that radiance is divided by before the denoiser and multiplied by after it: what the surface would reflect
// to the viewer under light that is the same from everywhere. Texture detail so passes around the filters.
#ifndef LIGHTLOOM_LIB_MODULATION
#define LIGHTLOOM_LIB_MODULATION

#include "lib/features.glsl"
#include "lib/reflectance.glsl"

// Below it a surface is so black that dividing would only amplify rounding.
const float kModulationFloor = 1e-3;

// `cosine`: between the shading normal and the direction to the viewer.
//
// The same for each lobe: who divides one lobe's radiance by its colour and who multiplies it again call the same
// function, so that an unfiltered lobe comes back to rounding, also where a colour is 0 in a channel.
vec3 diffuse_modulation(Bsdf bsdf, float cosine) { return max(diffuse_albedo(bsdf, cosine), vec3(kModulationFloor)); }

vec3 specular_modulation(Bsdf bsdf, float cosine) {
  vec3 reflectance = has_specular ? specular_fresnel(bsdf, cosine) : vec3(0.0);
  return max(reflectance, vec3(kModulationFloor));
}

// Both lobes together.
vec3 modulation_color(Bsdf bsdf, float cosine) {
  vec3 reflectance = diffuse_albedo(bsdf, cosine);
  if (has_specular) reflectance += specular_fresnel(bsdf, cosine);
  return max(reflectance, vec3(kModulationFloor));
}

// Specular part of the luminance of the reflectance: 0 for a Lambertian surface, 1 for a metal.
float specular_share(Bsdf bsdf, float cosine) { return has_specular ? specular_probability(bsdf, cosine) : 0.0; }

#endif
