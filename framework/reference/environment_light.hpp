#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "framework/reference/light_sample.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::reference {

/// Light from outside the scene. An image is filtered linearly between the centres of its texels (around in longitude),
/// and sampled by a density that is constant on each texel: in proportion to the integral of the filtered image over
/// the texel's place times its solid angle, so it is above 0 wherever the image is not black. Keeps a reference to the
/// environment.
class EnvironmentLight {
 public:
  explicit EnvironmentLight(const scene::Environment& environment);

  [[nodiscard]] bool shines() const { return shines_; }
  [[nodiscard]] bool is_image() const { return !environment_->rgb.empty(); }
  [[nodiscard]] glm::vec3 radiance(const glm::vec3& direction) const;
  [[nodiscard]] LightHit hit(const glm::vec3& direction) const { return {radiance(direction), pdf(direction)}; }
  /// `cell` picks a texel, `point` a direction within it; a constant environment is sampled uniformly.
  [[nodiscard]] LightSample sample(const glm::vec2& cell, const glm::vec2& point) const;

 private:
  [[nodiscard]] float pdf(const glm::vec3& direction) const;
  /// Of the image, before its scale.
  [[nodiscard]] glm::vec3 texel(size_t index) const;
  void build_table();

  const scene::Environment* environment_;
  bool shines_ = false;
  std::vector<double> rows_;    ///< cumulative probability of the rows
  std::vector<float> columns_;  ///< cumulative probability within each row
  std::vector<float> pdfs_;     ///< by texel [sr^-1]
};

}  // namespace lightloom::reference
