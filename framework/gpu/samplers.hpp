#pragma once

#include "framework/gpu/device.hpp"

namespace lightloom::gpu {

/// The samplers that shaders are given; no anisotropic filtering.
class Samplers {
 public:
  explicit Samplers(const Device& device);
  [[nodiscard]] VkSampler repeat_trilinear() const { return repeat_trilinear_.get(); }
  [[nodiscard]] VkSampler clamp_linear() const { return clamp_linear_.get(); }
  /// Repeats in u, clamps in v: equirectangular maps.
  [[nodiscard]] VkSampler equirectangular() const { return equirectangular_.get(); }

 private:
  SamplerHandle repeat_trilinear_;
  SamplerHandle clamp_linear_;
  SamplerHandle equirectangular_;
};

}  // namespace lightloom::gpu
