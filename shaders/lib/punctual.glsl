// Point, spot and directional lights of KHR_lights_punctual. They have no extent: only next event estimation finds them.
#ifndef LIGHTLOOM_LIB_PUNCTUAL
#define LIGHTLOOM_LIB_PUNCTUAL

#include "lib/grid.glsl"
#include "lib/light_visibility.glsl"
#include "lib/path_vertex.glsl"
#include "lib/scene.glsl"

// Falloff of a punctual light, as irradiance per intensity.
float punctual_attenuation(PunctualLight light, vec3 to_light, float distance_squared) {
  uint type = uint(light.direction.w);
  if (type == kPunctualDirectional) return 1.0;
  float attenuation = 1.0 / distance_squared;
  float range = light.position.w;
  if (range > 0.0) {
    float q = distance_squared / (range * range);
    attenuation *= clamp(1.0 - q * q, 0.0, 1.0);
  }
  if (type == kPunctualSpot) {
    float angular = clamp(dot(light.direction.xyz, -to_light) * light.cone.x + light.cone.y, 0.0, 1.0);
    attenuation *= angular * angular;
  }
  return attenuation;
}

// Light of one punctual light, picked uniformly by `u`, times their number.
PerLobe punctual_light(Grid grid, texture3D distance_field, texture3D material, PathVertex vertex, float u) {
  uint count = frame.counts.w;
  if (!has_punctual || count == 0u) return kNoLight;
  PunctualLight light = lights.punctual[min(uint(u * float(count)), count - 1u)];
  bool directional = uint(light.direction.w) == kPunctualDirectional;
  vec3 path = directional ? -light.direction.xyz : light.position.xyz - vertex.position;
  float distance_squared = max(dot(path, path), 1e-8 * grid.voxel_size * grid.voxel_size);
  vec3 direction = path * inversesqrt(distance_squared);
  vec3 arriving = light.intensity.rgb * punctual_attenuation(light, direction, distance_squared) * float(count);
  PerLobe reflected = scaled(reflectance_towards(vertex, direction), arriving);
  if (is_black(reflected)) return kNoLight;
  vec3 target = world_to_grid(grid, light.position.xyz);
  bool visible = directional ? !march_ray(distance_field, vertex.origin, direction, kFarAway).hit
                             : light_visible(distance_field, material, vertex.origin, target, 0u);
  if (!visible) return kNoLight;
  return reflected;
}

#endif
