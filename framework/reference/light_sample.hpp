#pragma once

#include <glm/glm.hpp>
#include <limits>

namespace lightloom::reference {

/// A direction in which a light may be seen.
struct LightSample {
  glm::vec3 direction{0, 1, 0};  ///< unit
  glm::vec3 radiance{0};         ///< [W m^-2 sr^-1]; of a light without extent the irradiance on a surface facing it
  float pdf = 0;                 ///< [sr^-1]; 0: no sample. Of a light without extent 1
  float distance = std::numeric_limits<float>::infinity();  ///< where the light is [m]
  bool point = false;                                       ///< a light without extent that has a place
};

/// Radiance that a ray met.
struct LightHit {
  glm::vec3 radiance{0};
  float pdf = 0;  ///< with which sampling the light would have drawn this direction [sr^-1]; 0: it could not have
};

}  // namespace lightloom::reference
