// Shadow rays through voxels towards points.
#ifndef LIGHTLOOM_LIB_LIGHT_VISIBILITY
#define LIGHTLOOM_LIB_LIGHT_VISIBILITY

#include "lib/march_boxes.glsl"

// A shadow ray may end this far from its target: there the target's own voxels begin.
const float kLightReach = 1.7320508;   // sqrt(3) voxels

// Is nothing between the vertex and a point on a light? Voxels of the same emissive material are the light itself.
bool light_visible(texture3D distance_field, texture3D material, vec3 origin, vec3 target, uint emission) {
  vec3 path = target - origin;
  float path_length = length(path);
  if (path_length <= kLightReach) return true;
  MarchHit hit = march_grid(distance_field, origin, path / path_length, path_length - kLightReach);
  if (!hit.hit) return true;
  return emission > 0u && uint(round(texelFetch(material, hit.voxel, 0).a * 255.0)) == emission;
}

#endif
