// Radiance from outside the scene.
#ifndef LIGHTLOOM_LIB_ENVIRONMENT
#define LIGHTLOOM_LIB_ENVIRONMENT

#include "lib/features.glsl"
#include "lib/textures.glsl"

// Equirectangular: row 0 is +y, column 0 is longitude -pi, longitude = atan(z, x).
vec2 environment_texcoord(vec3 direction) {
  const float pi = 3.14159265358979;
  float longitude = abs(direction.x) + abs(direction.z) > 0.0 ? atan(direction.z, direction.x) : 0.0;
  return vec2(longitude / (2.0 * pi) + 0.5, acos(clamp(direction.y, -1.0, 1.0)) / pi);
}

vec3 environment_radiance(vec3 direction) {
  if (!has_environment) return vec3(0.0);
  vec3 radiance = frame.environment.rgb;
  if (has_environment_image && frame.environment.w > 0.5)
    radiance *= textureLod(environment_map, environment_texcoord(direction), 0.0).rgb;
  return radiance;
}

#endif
