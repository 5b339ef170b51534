#include "framework/reference/sun_light.hpp"

#include <cmath>
#include <numbers>

namespace lightloom::reference {

SunLight::SunLight(const std::optional<scene::Sun>& sun, SunModel model) {
  if (!sun || sun->irradiance == glm::vec3(0)) return;
  irradiance_ = sun->irradiance;
  towards_ = Frame::around(glm::normalize(-sun->direction));
  if (model == SunModel::delta || !(sun->angular_radius > 0)) return;
  const double half_sine = std::sin(0.5 * static_cast<double>(sun->angular_radius));
  drop_ = 2 * half_sine * half_sine;
  // Cosine over the disc integrates to pi sin^2.
  radiance_ = glm::vec3(glm::dvec3(irradiance_) / (std::numbers::pi * drop_ * (2 - drop_)));
  pdf_ = static_cast<float>(1 / (2 * std::numbers::pi * drop_));
}

LightSample SunLight::sample(const glm::vec2& point) const {
  LightSample result;
  if (!shines()) return result;
  if (!has_extent()) return {towards_.z, irradiance_, 1};
  const auto fall = static_cast<float>(drop_ * static_cast<double>(point.x));
  const float radius = std::sqrt(fall * (2 - fall));
  const float azimuth = 2 * std::numbers::pi_v<float> * point.y;
  result.direction =
      glm::normalize(towards_.to_world(glm::vec3(radius * std::cos(azimuth), radius * std::sin(azimuth), 1 - fall)));
  result.radiance = radiance_;
  result.pdf = pdf_;
  return result;
}

LightHit SunLight::hit(const glm::vec3& direction) const {
  if (!has_extent()) return {};
  // Half the squared distance of unit vectors is 1 - cosine, with all its digits.
  const glm::dvec3 off = glm::dvec3(direction) - glm::dvec3(towards_.z);
  return 0.5 * glm::dot(off, off) <= drop_ ? LightHit{radiance_, pdf_} : LightHit{};
}

}  // namespace lightloom::reference
