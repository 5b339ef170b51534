#include "framework/reference/punctual_lights.hpp"

#include <algorithm>
#include <cmath>

namespace lightloom::reference {
namespace {

double luminance(const glm::vec3& color) {
  return static_cast<double>(glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f)));
}

}  // namespace

PunctualLights::PunctualLights(const std::vector<scene::PunctualLight>& lights) {
  for (const scene::PunctualLight& light : lights) {
    if (light.intensity == glm::vec3(0)) continue;
    const double inner = std::cos(static_cast<double>(light.inner_cone));
    const double outer = std::cos(static_cast<double>(light.outer_cone));
    const double scale = 1 / std::max(0.001, inner - outer);
    lights_.push_back({light, scale, -outer * scale});
  }
}

LightSample PunctualLights::arriving(const Light& light, const glm::vec3& position) {
  const scene::PunctualLight& source = light.source;
  if (source.type == scene::PunctualType::directional) return {-source.direction, source.intensity, 1};
  const glm::dvec3 path = glm::dvec3(source.position) - glm::dvec3(position);
  const double squared = glm::dot(path, path);
  if (!(squared > 0)) return {};
  const double distance = std::sqrt(squared);
  const glm::dvec3 direction = path / distance;
  double falloff = 1 / squared;
  if (source.range > 0) {
    const double ratio = distance / static_cast<double>(source.range);
    falloff *= std::clamp(1 - std::pow(ratio, 4), 0.0, 1.0);
  }
  if (source.type == scene::PunctualType::spot) {
    const double cosine = -glm::dot(glm::dvec3(source.direction), direction);
    const double inside = std::clamp(cosine * light.cosine_scale + light.cosine_offset, 0.0, 1.0);
    falloff *= inside * inside;
  }
  return {glm::vec3(direction), glm::vec3(glm::dvec3(source.intensity) * falloff), 1, static_cast<float>(distance),
          true};
}

LightSample PunctualLights::sample(const glm::vec3& position, float pick) const {
  if (lights_.empty()) return {};
  if (lights_.size() == 1) return arriving(lights_.front(), position);
  double total = 0;
  for (const Light& light : lights_) total += luminance(arriving(light, position).radiance);
  double left = static_cast<double>(pick) * total;
  LightSample result;
  result.pdf = 0;
  for (const Light& light : lights_) {
    const LightSample candidate = arriving(light, position);
    const double weight = luminance(candidate.radiance);
    if (!(weight > 0)) continue;
    result = candidate;
    result.radiance *= static_cast<float>(total / weight);
    if (left < weight) break;
    left -= weight;
  }
  return result;
}

}  // namespace lightloom::reference
