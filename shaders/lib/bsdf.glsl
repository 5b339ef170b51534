// Reflection of a surface: a Lambertian base under a Ward lobe, mixed with a metal, as glTF's metallic-roughness model
// with KHR_materials_specular and _anisotropy describes a material. Local frame as in ward.glsl.
//
//   f = (1 - metallic) (diffuse + F_d ward) + metallic F_m ward
//   diffuse = base / pi * (1 - F_d(i.z)) (1 - F_d(o.z)) / (1 - mean F_d)
//
// F_d is Schlick's Fresnel term between F0 and F90 of the dielectric, F_m the one between the base colour and 1. The
// diffuse factor is that of Shirley et al. 1997: reciprocal, and the base's directional albedo is exactly
// base (1 - F_d(i.z)), so that base and lobe together reflect no more than arrives.
#ifndef LIGHTLOOM_LIB_BSDF
#define LIGHTLOOM_LIB_BSDF

#include "lib/color.glsl"
#include "lib/features.glsl"
#include "lib/ward.glsl"

struct Bsdf {
  vec3 base_color;
  float metallic;
  float f0;      // of the dielectric, at normal incidence
  float f90;     // of the dielectric, at grazing incidence
  vec2 alpha;
};

struct BsdfSample {
  vec3 direction;
  vec3 weight;   // f cos / pdf; 0: the path ends
  float pdf;     // [sr^-1], of all lobes together; meaningless for a mirror
  bool mirror;   // the direction has no density: no other strategy could have found it
  float roughness;   // of the lobe that was picked: the larger alpha, 1 for the base
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

vec3 diffuse_evaluate(Bsdf bsdf, float i_z, float o_z) {
  float mean_fresnel = bsdf.f0 + (bsdf.f90 - bsdf.f0) / 21.0;   // cosine-weighted mean of Schlick's term
  float outgoing = (1.0 - schlick(bsdf.f0, bsdf.f90, o_z)) / max(1.0 - mean_fresnel, 1e-3);
  return diffuse_albedo(bsdf, i_z) * (outgoing / kPi);
}

// Probability with which the specular lobe is sampled: its share of the luminance reflected towards i.
float specular_probability(Bsdf bsdf, float i_z) {
  float specular = luminance(specular_fresnel(bsdf, i_z));
  float total = specular + luminance(diffuse_albedo(bsdf, i_z));
  return total > 0.0 ? specular / total : 0.0;
}

// f(i, o) [sr^-1] without the cosine. A mirror's lobe is left out: only sampling finds it.
vec3 bsdf_evaluate(Bsdf bsdf, vec3 i, vec3 o) {
  if (i.z <= kWardMinimumCosine || o.z <= kWardMinimumCosine) return vec3(0.0);
  vec3 f = diffuse_evaluate(bsdf, i.z, o.z);
  if (has_specular && !ward_is_mirror(bsdf.alpha))
    f += specular_fresnel(bsdf, dot(i, normalize(i + o))) * ward_evaluate(i, o, bsdf.alpha);
  return f;
}

// Density with which bsdf_sample picks o [sr^-1], mirrors left out.
float bsdf_pdf(Bsdf bsdf, vec3 i, vec3 o) {
  if (i.z <= kWardMinimumCosine || o.z <= kWardMinimumCosine) return 0.0;
  float specular = has_specular ? specular_probability(bsdf, i.z) : 0.0;
  float pdf = (1.0 - specular) * o.z / kPi;
  if (has_specular && !ward_is_mirror(bsdf.alpha)) pdf += specular * ward_pdf(i, o, bsdf.alpha);
  return pdf;
}

vec3 sample_cosine_hemisphere(vec2 u) {
  float radius = sqrt(u.x);
  float phi = kPi * (2.0 * u.y - 1.0);
  return vec3(radius * cos(phi), radius * sin(phi), sqrt(max(0.0, 1.0 - u.x)));
}

// One direction from the mixture of both lobes. `u`: three uniform numbers.
BsdfSample bsdf_sample(Bsdf bsdf, vec3 i, vec3 u) {
  BsdfSample result = BsdfSample(vec3(0.0, 0.0, 1.0), vec3(0.0), 0.0, false, 1.0);
  if (i.z <= kWardMinimumCosine) return result;
  float specular = has_specular ? specular_probability(bsdf, i.z) : 0.0;
  bool pick_specular = u.x < specular;
  if (pick_specular) result.roughness = max(bsdf.alpha.x, bsdf.alpha.y);
  if (pick_specular && ward_is_mirror(bsdf.alpha)) {
    result.direction = vec3(-i.xy, i.z);
    result.weight = specular_fresnel(bsdf, i.z) / specular;
    result.mirror = true;
    return result;
  }
  result.direction = pick_specular ? ward_sample(i, u.yz, bsdf.alpha) : sample_cosine_hemisphere(u.yz);
  result.pdf = bsdf_pdf(bsdf, i, result.direction);
  if (result.pdf > 0.0) result.weight = bsdf_evaluate(bsdf, i, result.direction) * (result.direction.z / result.pdf);
  return result;
}

#endif
