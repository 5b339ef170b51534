#pragma once

#include <string>

#include "framework/graph/plan.hpp"
#include "framework/image/host_image.hpp"

namespace lightloom::study {

/// How linear radiance is shown; the formulas are those of shaders/tonemap.comp.
struct ToneMap {
  double exposure = 0;           ///< [EV]
  std::string curve = "filmic";  ///< or "reinhard", "linear"
};

/// What the first pass of type `tonemap` in the plan does; the default where there is none.
[[nodiscard]] ToneMap tone_map_of(const Plan& plan);

/// Two-dimensional image of 3 or more channels to rgba8_unorm, sRGB-encoded. What is not finite is black.
[[nodiscard]] image::HostImage tone_map(const image::HostImage& radiance, const ToneMap& how);

}  // namespace lightloom::study
