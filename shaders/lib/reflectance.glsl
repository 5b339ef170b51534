// What a surface reflects as a whole: the lobes of a material and how much light each takes, without the shapes of the
// lobes (bsdf.glsl). Local frame: x tangent, y bitangent, z normal.
#ifndef LIGHTLOOM_LIB_REFLECTANCE
#define LIGHTLOOM_LIB_REFLECTANCE

#include "lib/color.glsl"

struct Bsdf {
  vec3 base_color;
  float metallic;
  float f0;      // of the dielectric, at normal incidence
  float f90;     // of the dielectric, at grazing incidence
  vec2 alpha;    // of the Ward lobe, along x and y
};

float schlick(float f0, float f90, float cosine) {
  float m = clamp(1.0 - cosine, 0.0, 1.0);
  float m2 = m * m;
  return f0 + (f90 - f0) * (m2 * m2 * m);
}

// Specular reflectance at an angle from the half vector (or, as an estimate, from the normal).
vec3 specular_fresnel(Bsdf bsdf, float cosine) {
  float grazing = schlick(0.0, 1.0, cosine);
  vec3 metal = bsdf.base_color + (vec3(1.0) - bsdf.base_color) * grazing;
  return mix(vec3(bsdf.f0 + (bsdf.f90 - bsdf.f0) * grazing), metal, bsdf.metallic);
}

// Fraction of the light from direction z = `cosine` that the base scatters.
vec3 diffuse_albedo(Bsdf bsdf, float cosine) {
  return bsdf.base_color * ((1.0 - bsdf.metallic) * (1.0 - schlick(bsdf.f0, bsdf.f90, cosine)));
}

// Probability with which the specular lobe is sampled: its share of the luminance reflected towards i.
float specular_probability(Bsdf bsdf, float i_z) {
  float specular = luminance(specular_fresnel(bsdf, i_z));
  float total = specular + luminance(diffuse_albedo(bsdf, i_z));
  return total > 0.0 ? specular / total : 0.0;
}

#endif
