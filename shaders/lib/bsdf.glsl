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

#include "lib/features.glsl"
#include "lib/reflectance.glsl"
#include "lib/ward.glsl"

// Something for the base and for the lobe over it.
struct PerLobe {
  vec3 diffuse;
  vec3 specular;
};

PerLobe scaled(PerLobe x, vec3 factor) { return PerLobe(x.diffuse * factor, x.specular * factor); }
PerLobe sum_of(PerLobe x, PerLobe y) { return PerLobe(x.diffuse + y.diffuse, x.specular + y.specular); }

struct BsdfSample {
  vec3 direction;
  vec3 weight;   // f cos / pdf; 0: the path ends
  vec3 specular_weight;   // the part of it that the specular lobe scatters
  float pdf;     // [sr^-1], of all lobes together; meaningless for a mirror
  bool mirror;   // the direction has no density: no other strategy could have found it
  float roughness;   // of the lobe that was picked: the larger alpha, 1 for the base
};

vec3 diffuse_evaluate(Bsdf bsdf, float i_z, float o_z) {
  float mean_fresnel = bsdf.f0 + (bsdf.f90 - bsdf.f0) / 21.0;   // cosine-weighted mean of Schlick's term
  float outgoing = (1.0 - schlick(bsdf.f0, bsdf.f90, o_z)) / max(1.0 - mean_fresnel, 1e-3);
  return diffuse_albedo(bsdf, i_z) * (outgoing / kPi);
}

// f(i, o) [sr^-1] of each lobe without the cosine. A mirror's lobe is left out: only sampling finds it.
PerLobe bsdf_evaluate_lobes(Bsdf bsdf, vec3 i, vec3 o) {
  PerLobe f = PerLobe(vec3(0.0), vec3(0.0));
  if (!ward_reflects(i.z, o.z)) return f;
  f.diffuse = diffuse_evaluate(bsdf, i.z, o.z);
  if (has_specular && !ward_is_mirror(bsdf.alpha))
    f.specular = specular_fresnel(bsdf, dot(i, normalize(i + o))) * ward_evaluate(i, o, bsdf.alpha);
  return f;
}

vec3 bsdf_evaluate(Bsdf bsdf, vec3 i, vec3 o) {
  PerLobe f = bsdf_evaluate_lobes(bsdf, i, o);
  return f.diffuse + f.specular;
}

// Density with which bsdf_sample picks o [sr^-1], mirrors left out.
float bsdf_pdf(Bsdf bsdf, vec3 i, vec3 o) {
  if (!ward_reflects(i.z, o.z)) return 0.0;
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
  BsdfSample result = BsdfSample(vec3(0.0, 0.0, 1.0), vec3(0.0), vec3(0.0), 0.0, false, 1.0);
  if (i.z <= kWardMinimumCosine) return result;
  float specular = has_specular ? specular_probability(bsdf, i.z) : 0.0;
  bool pick_specular = u.x < specular;
  if (pick_specular) result.roughness = max(bsdf.alpha.x, bsdf.alpha.y);
  if (pick_specular && ward_is_mirror(bsdf.alpha)) {
    result.direction = vec3(-i.xy, i.z);
    result.weight = specular_fresnel(bsdf, i.z) / specular;
    result.specular_weight = result.weight;
    result.mirror = true;
    return result;
  }
  vec3 o = pick_specular ? ward_sample(i, u.yz, bsdf.alpha) : sample_cosine_hemisphere(u.yz);
  result.direction = o;
  if (!ward_reflects(i.z, o.z)) return result;
  result.pdf = (1.0 - specular) * o.z / kPi;
  vec3 diffuse = diffuse_evaluate(bsdf, i.z, o.z) * o.z;
  vec3 lobe = vec3(0.0);
  if (has_specular && !ward_is_mirror(bsdf.alpha)) {
    float lobe_pdf = ward_pdf(i, o, bsdf.alpha);
    result.pdf += specular * lobe_pdf;
    // The lobe's value by its weight: one exponential for both.
    lobe = specular_fresnel(bsdf, dot(i, normalize(i + o))) * (ward_weight(i, o, bsdf.alpha) * lobe_pdf);
  }
  if (!(result.pdf > 0.0)) return result;
  result.weight = (diffuse + lobe) / result.pdf;
  result.specular_weight = lobe / result.pdf;
  return result;
}

#endif
