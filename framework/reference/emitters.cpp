#include "framework/reference/emitters.hpp"

#include <algorithm>
#include <cmath>

namespace lightloom::reference {
namespace {

constexpr uint32_t kMeanSamples = 256;

/// Share of the emission factor's luminance that a triangle counts with beside its mean, so that none is lost.
constexpr double kLeastShare = 0.002;

double luminance(const glm::vec3& color) {
  return static_cast<double>(glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f)));
}

/// Uniform on a triangle: points of the square above the diagonal are folded back.
TrianglePoint uniform_point(uint32_t triangle, glm::vec2 u) {
  if (u.x + u.y > 1) u = 1.0f - u;
  return {triangle, u.x, u.y};
}

double mean_luminance(const SceneTriangles& triangles, const Materials& materials, uint32_t index) {
  const uint32_t material = triangles.triangle(index).material;
  const scene::Material& source = triangles.scene().materials[material];
  const double factor = luminance(source.emission);
  if (source.emissive_texture.image < 0) return factor;
  double sum = 0;
  for (uint32_t i = 0; i < kMeanSamples; ++i) {
    // Golden-section lattice.
    const double y = i * 0.6180339887498949;
    const glm::vec2 u((static_cast<float>(i) + 0.5f) / kMeanSamples, static_cast<float>(y - std::floor(y)));
    sum += luminance(materials.emission(material, triangles.texture_point(uniform_point(index, u))));
  }
  return sum / kMeanSamples + kLeastShare * factor;
}

double area_of(const SceneTriangles& triangles, uint32_t index) {
  const scene::Triangle& t = triangles.triangle(index);
  const glm::dvec3 a(triangles.vertex(t.a).position);
  return 0.5 * glm::length(glm::cross(glm::dvec3(triangles.vertex(t.b).position) - a,
                                      glm::dvec3(triangles.vertex(t.c).position) - a));
}

}  // namespace

Emitters::Emitters(const SceneTriangles& triangles, const Materials& materials) {
  const auto count = static_cast<uint32_t>(triangles.scene().triangles.size());
  std::vector<double> areas;
  double total = 0;
  for (uint32_t index = 0; index < count; ++index) {
    const Materials::Traits& traits = materials.traits(triangles.triangle(index).material);
    if (!traits.emits) continue;
    const double area = area_of(triangles, index);
    const double power = area * mean_luminance(triangles, materials, index) * (traits.double_sided ? 2 : 1);
    if (!(power > 0)) continue;
    triangles_.push_back(index);
    areas.push_back(area);
    cumulative_.push_back(total += power);
  }
  if (empty()) return;
  densities_.resize(count);
  double before = 0;
  for (size_t i = 0; i < triangles_.size(); ++i) {
    const double power = cumulative_[i] - before;
    before = cumulative_[i];
    cumulative_[i] /= total;
    densities_[triangles_[i]] = static_cast<float>(power / total / areas[i]);
  }
}

Emitters::Sample Emitters::sample(const glm::vec2& pick, const glm::vec2& point) const {
  // Both numbers together, so that the least of a million emitters is picked as often as it should be.
  const double place = static_cast<double>(pick.x) + static_cast<double>(pick.y) * 0x1p-24;
  const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), place);
  const auto index = static_cast<size_t>(std::min(found, cumulative_.end() - 1) - cumulative_.begin());
  return {uniform_point(triangles_[index], point), densities_[triangles_[index]]};
}

}  // namespace lightloom::reference
