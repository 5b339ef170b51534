#pragma once

#include "framework/reference/environment_light.hpp"
#include "framework/reference/punctual_lights.hpp"
#include "framework/reference/sun_light.hpp"

namespace lightloom::reference {

/// The lights of a frame that are no surfaces.
struct Lights {
  SunLight sun;
  const EnvironmentLight* environment = nullptr;
  PunctualLights punctual;
};

}  // namespace lightloom::reference
