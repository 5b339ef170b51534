// Point, spot and directional lights of KHR_lights_punctual. They have no extent: only next event estimation finds them.
// Who calls looks for what is in the way.
#ifndef LIGHTLOOM_LIB_PUNCTUAL
#define LIGHTLOOM_LIB_PUNCTUAL

#include "lib/features.glsl"
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

// Light of one of the punctual lights, which must not be closer than `closest` [m], times their number.
LightSample punctual_sample(PathVertex vertex, PunctualLight light, float closest) {
  bool directional = uint(light.direction.w) == kPunctualDirectional;
  vec3 path = directional ? -light.direction.xyz : light.position.xyz - vertex.position;
  float distance_squared = max(dot(path, path), closest * closest);
  vec3 direction = path * inversesqrt(distance_squared);
  vec3 arriving =
      light.intensity.rgb * punctual_attenuation(light, direction, distance_squared) * float(frame.counts.w);
  return LightSample(direction, scaled(reflectance_towards(vertex, direction), arriving));
}

// Picks a punctual light uniformly by `u`; false where there is none.
bool pick_punctual(float u, out PunctualLight light) {
  uint count = frame.counts.w;
  if (!has_punctual || count == 0u) return false;
  light = lights.punctual[min(uint(u * float(count)), count - 1u)];
  return true;
}

#endif
