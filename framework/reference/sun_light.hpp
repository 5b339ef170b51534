#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "framework/reference/frame.hpp"
#include "framework/reference/light_sample.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::reference {

enum class SunModel : uint8_t { delta, disc };

/// The sun: a direction, or a disc of even radiance; the irradiance on a surface that faces it is the same.
class SunLight {
 public:
  SunLight(const std::optional<scene::Sun>& sun, SunModel model);

  [[nodiscard]] bool shines() const { return irradiance_ != glm::vec3(0); }
  /// Can rays meet it?
  [[nodiscard]] bool has_extent() const { return drop_ > 0; }
  [[nodiscard]] LightSample sample(const glm::vec2& point) const;
  [[nodiscard]] LightHit hit(const glm::vec3& direction) const;

 private:
  Frame towards_;  ///< z: at the sun
  glm::vec3 irradiance_{0};
  glm::vec3 radiance_{0};
  double drop_ = 0;  ///< 1 - cosine of the angular radius
  float pdf_ = 0;
};

}  // namespace lightloom::reference
