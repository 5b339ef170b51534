// Next event estimation at a vertex of a path: one sample of the emissive surfaces, one of the sun, one of the
// environment, one punctual light.
#ifndef LIGHTLOOM_LIB_LIGHTS
#define LIGHTLOOM_LIB_LIGHTS

#include "lib/emitters.glsl"
#include "lib/environment_light.glsl"
#include "lib/punctual.glsl"
#include "lib/random.glsl"
#include "lib/sun.glsl"

// Direct light that each lobe reflects at vertex `bounce` of a path.
PerLobe direct_light(Grid grid, texture3D distance_field, texture3D normals, texture3D materials, PathVertex vertex,
                     RandomKey key, uint bounce) {
  vec4 u = random4(key, bounce, kDimensionLight);
  PerLobe light = emitter_light(grid, distance_field, normals, materials, vertex, key, bounce, u.x);
  light = sum_of(light, sun_light(distance_field, vertex, u.yz));
  if (environment_sampled())
    light = sum_of(light, environment_light(distance_field, vertex, random4(key, bounce, kDimensionEnvironment)));
  return sum_of(light, punctual_light(grid, distance_field, materials, vertex, u.w));
}

#endif
