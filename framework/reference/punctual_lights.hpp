#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "framework/reference/light_sample.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::reference {

/// Point, spot and directional lights of KHR_lights_punctual.
class PunctualLights {
 public:
  explicit PunctualLights(const std::vector<scene::PunctualLight>& lights);

  [[nodiscard]] bool empty() const { return lights_.empty(); }
  /// One of the lights, picked by the luminance that arrives at a place; `radiance` is its irradiance there over the
  /// probability of the pick, `pdf` 1. No sample (pdf 0) where no light arrives.
  [[nodiscard]] LightSample sample(const glm::vec3& position, float pick) const;

 private:
  struct Light {
    scene::PunctualLight source;
    double cosine_scale = 0, cosine_offset = 0;  ///< of a spot's falloff from its outer to its inner cone
  };
  [[nodiscard]] static LightSample arriving(const Light& light, const glm::vec3& position);

  std::vector<Light> lights_;
};

}  // namespace lightloom::reference
