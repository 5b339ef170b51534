// Light of emissive faces at the first hit by the sample that the pixel's reservoir holds.
#ifndef LIGHTLOOM_LIB_RESERVOIR_LIGHT
#define LIGHTLOOM_LIB_RESERVOIR_LIGHT

#include "lib/emitters.glsl"
#include "lib/reservoir_target.glsl"

layout(constant_id = 40) const bool reservoir_bound = false;

uniform utexture2D reservoir;

// Does a reservoir stand for the emissive surfaces that vertex 0 samples? If so, `light` is what it finds of them: one ray,
// an unbiased estimate as any draw of its own would be. A reservoir that knows nothing leaves that draw to the vertex.
bool reservoir_light(Grid grid, texture3D distance_field, PathVertex vertex, ivec2 pixel, out PerLobe light) {
  light = kNoLight;
  if (!reservoir_bound || !has_emissive || !kSampleLights) return false;
  Reservoir held = unpack_reservoir(texelFetch(reservoir, pixel, 0));
  FacePoint point = face_point_of(held);
  if (point.probability > 0.0) light = face_point_light(grid, voxels_normal, voxels_material, vertex, point,
                                                            reservoir_draws);
  bool seen = !is_black(light) && face_visible(distance_field, vertex, point);
  light = seen ? scaled(light, vec3(point.probability * held.weight)) : kNoLight;
  return held.count > 0.0;
}

#endif
