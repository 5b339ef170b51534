#include "framework/reference/bsdf.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lightloom::reference {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// Directions nearer to the horizon than this reflect nothing.
constexpr float kLeastCosine = 1e-6f;

/// Lobes narrower than this along both axes reflect like a mirror: materials have alphas of at least 1e-3, which is
/// what a roughness of 0 becomes.
constexpr float kMirrorAlpha = 1.01e-3f;
constexpr float kLeastAlpha = 1e-4f;

float luminance(const glm::vec3& color) {
  return 0.2126f * color.r + 0.7152f * color.g + 0.0722f * color.b;
}

/// Schlick's fifth power: the step from F0 to F90.
float grazing(float cosine) {
  const float m = std::clamp(1 - cosine, 0.0f, 1.0f);
  return m * m * (m * m) * m;
}

float dielectric(const Reflectance& r, float grazing_step) {
  return r.f0 + (r.f90 - r.f0) * grazing_step;
}

glm::vec3 specular_reflectance(const Reflectance& r, float cosine) {
  const float step = grazing(cosine);
  const glm::vec3 glass(dielectric(r, step) * (1 - r.metallic));
  if (r.metallic == 0) return glass;
  return glass + (r.base_color + (1.0f - r.base_color) * step) * r.metallic;
}

glm::vec3 base_reflectance(const Reflectance& r, float cosine) {
  return r.base_color * ((1 - r.metallic) * (1 - dielectric(r, grazing(cosine))));
}

/// The lobe without Fresnel's factor, for a half vector of unit length.
struct WardValue {
  float f = 0;
  float pdf = 0;
};

WardValue ward_lobe(WardForm form, const glm::vec2& alpha, const glm::vec3& view, const glm::vec3& direction,
                    const glm::vec3& half, float half_view) {
  const float sx = half.x / alpha.x, sy = half.y / alpha.y;
  const float z2 = half.z * half.z;
  // Beckmann's D times cos^4 of the half vector's angle.
  const float slopes = std::exp(-(sx * sx + sy * sy) / z2) / (kPi * alpha.x * alpha.y);
  WardValue value;
  value.pdf = slopes / (4 * half_view * z2 * half.z);
  const float cosines = view.z * direction.z;
  switch (form) {
    case WardForm::ward_1992:
      value.f = slopes / (4 * std::sqrt(cosines));
      break;
    case WardForm::dur:
      value.f = slopes / (4 * cosines);
      break;
    case WardForm::bounded:
      value.f = slopes / (4 * half_view * half_view * z2 * z2);
      break;
  }
  return value;
}

glm::vec3 cosine_hemisphere(const glm::vec2& point) {
  const float radius = std::sqrt(point.x);
  const float azimuth = 2 * kPi * point.y;
  return {radius * std::cos(azimuth), radius * std::sin(azimuth), std::sqrt(1 - point.x)};
}

}  // namespace

Lobes reflected_fractions(const Reflectance& reflectance, float cosine) {
  return {base_reflectance(reflectance, cosine), specular_reflectance(reflectance, cosine)};
}

Bsdf::Bsdf(const Reflectance& reflectance, WardForm form, const glm::vec3& view)
    : reflectance_(reflectance), form_(form), view_(view) {
  const float mean = reflectance.f0 + (reflectance.f90 - reflectance.f0) / 21;
  base_ = base_reflectance(reflectance, view.z);
  specular_ = reflectance.f0 > 0 || reflectance.f90 > 0 || reflectance.metallic > 0;
  if (specular_) {
    const float specular = luminance(specular_reflectance(reflectance, view.z));
    const float total = specular + luminance(base_);
    specular_probability_ = total > 0 ? specular / total : 0;
    mirror_ = std::max(reflectance.alpha.x, reflectance.alpha.y) < kMirrorAlpha;
    reflectance_.alpha = glm::clamp(reflectance.alpha, kLeastAlpha, 1.0f);
  }
  base_ /= kPi * std::max(1 - mean, 1e-3f);
}

glm::vec3 Bsdf::fresnel(float cosine) const {
  return specular_reflectance(reflectance_, cosine);
}

Bsdf::Evaluation Bsdf::evaluate(const glm::vec3& direction) const {
  Evaluation result;
  if (view_.z <= kLeastCosine || direction.z <= kLeastCosine) return result;
  const float escaping = specular_ ? 1 - dielectric(reflectance_, grazing(direction.z)) : 1;
  result.value.diffuse = base_ * (escaping * direction.z);
  result.pdf = (1 - specular_probability_) * direction.z / kPi;
  if (!specular_ || mirror_) return result;
  const glm::vec3 half = glm::normalize(view_ + direction);
  const float half_view = glm::dot(half, view_);
  const WardValue ward = ward_lobe(form_, reflectance_.alpha, view_, direction, half, half_view);
  result.value.specular = fresnel(half_view) * (ward.f * direction.z);
  result.pdf += specular_probability_ * ward.pdf;
  return result;
}

glm::vec3 Bsdf::sample_lobe(const glm::vec2& point) const {
  const float radius = std::sqrt(-std::log(1 - point.x));
  const float azimuth = 2 * kPi * point.y;
  const glm::vec3 half = glm::normalize(glm::vec3(reflectance_.alpha.x * radius * std::cos(azimuth),
                                                  reflectance_.alpha.y * radius * std::sin(azimuth), 1));
  const float cosine = glm::dot(half, view_);
  return cosine > 0 ? half * (2 * cosine) - view_ : glm::vec3(0, 0, -1);
}

Bsdf::Sample Bsdf::mirrored() const {
  Sample result;
  result.direction = {-view_.x, -view_.y, view_.z};
  result.weight.specular = fresnel(view_.z) / specular_probability_;
  result.mirror = true;
  return result;
}

Bsdf::Sample Bsdf::sample(float pick, const glm::vec2& point) const {
  Sample result;
  if (view_.z <= kLeastCosine) return result;
  const bool lobe = pick < specular_probability_;
  if (lobe && mirror_) return mirrored();
  result.direction = lobe ? sample_lobe(point) : cosine_hemisphere(point);
  const Evaluation evaluation = evaluate(result.direction);
  if (!(evaluation.pdf > 0)) return result;
  result.pdf = evaluation.pdf;
  result.weight.add_scaled(evaluation.value, glm::vec3(1 / evaluation.pdf));
  return result;
}

}  // namespace lightloom::reference
