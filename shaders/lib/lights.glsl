// Next event estimation at a vertex of a path through voxels: one sample of the emissive surfaces, one of the sun, one of
// the environment, one punctual light.
#ifndef LIGHTLOOM_LIB_LIGHTS
#define LIGHTLOOM_LIB_LIGHTS

#include "lib/emitters.glsl"
#include "lib/environment_light.glsl"
#include "lib/path_random.glsl"
#include "lib/punctual.glsl"
#include "lib/sun.glsl"

// What is left of a sample of light from far away.
PerLobe distant_light(texture3D distance_field, PathVertex vertex, LightSample far) {
  if (is_black(far.light) || march_grid(distance_field, vertex.origin, far.direction, kFarAway).hit) return kNoLight;
  return far.light;
}

// Light of one punctual light, picked uniformly by `u`.
PerLobe punctual_light(Grid grid, texture3D distance_field, texture3D materials, PathVertex vertex, float u) {
  PunctualLight source;
  if (!pick_punctual(u, source)) return kNoLight;
  LightSample near = punctual_sample(vertex, source, 1e-4 * grid.voxel_size);
  if (uint(source.direction.w) == kPunctualDirectional) return distant_light(distance_field, vertex, near);
  vec3 target = world_to_grid(grid, source.position.xyz);
  if (is_black(near.light) || !light_visible(distance_field, materials, vertex.origin, target, 0u)) return kNoLight;
  return near.light;
}

// Direct light that each lobe reflects at vertex `bounce` of a path; that of emissive surfaces only if `with_emitters`.
PerLobe direct_light(Grid grid, texture3D distance_field, texture3D normals, texture3D materials, PathVertex vertex,
                     RandomKey key, uint bounce, bool with_emitters) {
  vec4 u = path_random4(key, bounce, kDimensionLight);
  PerLobe light = kNoLight;
  if (with_emitters) light = emitter_light(grid, distance_field, normals, materials, vertex, key, bounce, u.x);
  light = sum_of(light, distant_light(distance_field, vertex, sun_sample(vertex, u.yz)));
  if (environment_sampled()) {
    LightSample sky = environment_sample(vertex, path_random4(key, bounce, kDimensionEnvironment));
    light = sum_of(light, distant_light(distance_field, vertex, sky));
  }
  return sum_of(light, punctual_light(grid, distance_field, materials, vertex, u.w));
}

#endif
