// What radiance_cache.light knows of voxels: light, and in a the number of its samples, 0 where nothing is known.
#ifndef LIGHTLOOM_LIB_CACHED_LIGHT
#define LIGHTLOOM_LIB_CACHED_LIGHT

#include "lib/scene.glsl"

uniform texture3D cache;

layout(constant_id = 33) const bool cache_bound = false;

// That of a frame ago, for the pass itself.
vec4 past_light(ivec3 voxel) {
  return cache_bound && frame.ids.z > 0u ? texelFetch(cache, voxel, 0) : vec4(0.0);
}

#endif
